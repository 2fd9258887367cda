//! `(define (domain NAME) section …)`: finding the definition and its sections.

use super::sink::Sink;
use crate::Span;
use crate::diagnostic::{DiagnosticKind, FileKind};
use crate::model::Name;
use crate::syntax::{Node, NodeKind, Tree};
use diagnostics::nearest;

/// The definition that a file holds.
pub(crate) struct Header<'t> {
    pub(crate) define: Node<'t>,
    pub(crate) name: Name,
    /// Lists that start with a keyword, in the order of the source.
    pub(crate) sections: Vec<(&'t str, Node<'t>)>,
}

impl<'t> Header<'t> {
    /// The sections of that name, in order.
    pub(crate) fn all<'a>(&'a self, keyword: &'a str) -> impl Iterator<Item = Node<'t>> + 'a {
        self.sections.iter().filter(move |(k, _)| k.eq_ignore_ascii_case(keyword)).map(|(_, n)| *n)
    }

    /// The section of that name; each further one is an error.
    pub(crate) fn one(&self, sink: &mut Sink, keyword: &str) -> Option<Node<'t>> {
        let mut all = self.all(keyword);
        let first = all.next();
        for again in all {
            let name = keyword.to_owned();
            sink.report(super::sink::first_word(again), DiagnosticKind::Repeated { name });
        }
        first
    }
}

/// Whether the file starts like `domain x {`, as RDDL does.
fn is_rddl(tree: &Tree<'_>) -> bool {
    let first: Vec<Node<'_>> = tree.roots().take(4).collect();
    let starts = |word: &str| first.first().is_some_and(|n| n.is(word));
    (starts("domain") || starts("non-fluents") || starts("instance"))
        && first.iter().skip(1).any(|n| !n.is_list() && n.text().contains('{'))
}

/// The first definition of that kind in the file. Definitions of the other kind may stand around it.
pub(crate) fn header<'t>(
    sink: &mut Sink,
    tree: &'t Tree<'t>,
    kind: FileKind,
    known: &'static [&'static str],
) -> Option<Header<'t>> {
    let word = kind.to_string();
    let is_define = |n: &Node<'t>| n.is_headed("define") || n.is_headed("defdomain");
    let of_kind = |n: &Node<'t>| is_define(n) && n.children().nth(1).is_some_and(|h| h.is_headed(&word));
    let Some(define) = tree.roots().find(of_kind) else {
        let span = tree.roots().next().map_or(Span::new(0, 0), super::sink::first_word);
        let kind = match is_rddl(tree) {
            true => DiagnosticKind::OtherLanguage,
            false => DiagnosticKind::NotADefinition { expected: kind },
        };
        sink.report(span, kind);
        return None;
    };
    for root in tree.roots().skip_while(|n| n.span().start <= define.span().start) {
        if !is_define(&root) {
            sink.report(root.span(), DiagnosticKind::TrailingText);
        }
    }
    let mut parts = define.children().skip(1);
    let title: Vec<Node<'t>> = parts.next().map(|h| h.children().collect()).unwrap_or_default();
    if let [_, name, ..] = title.as_slice()
        && name.is_name()
    {
        sink.declare(kind.name_kind(), *name, None);
    }
    let name = match title.as_slice() {
        [_, name] if name.is_name() => Name::new(name.text()),
        [_, name, rest, ..] if name.is_name() => {
            sink.unexpected(*rest, "one name only");
            Name::new(name.text())
        }
        [_, other, ..] => {
            sink.unexpected(*other, "a name");
            Name::new("")
        }
        _ => {
            sink.missing(title.first().copied().unwrap_or(define), format!("the {kind}"), "name");
            Name::new("")
        }
    };
    let mut sections = Vec::new();
    for part in parts {
        match part.head() {
            Some(head) if head.kind() == NodeKind::Keyword => {
                if known.iter().any(|k| head.is(k)) {
                    sections.push((head.text(), part));
                } else {
                    let suggestion = nearest(head.text(), known.iter().copied());
                    let name = head.text().to_owned();
                    sink.report(head.span(), DiagnosticKind::UnknownSection { name, suggestion });
                }
            }
            _ => sink.unexpected(part, "a section such as `(:init …)`"),
        }
    }
    Some(Header { define, name, sections })
}
