//! The context of a cursor in a text that is being written.
//!
//! Problem: while an author types, parentheses are missing and the tree is of little use. Idea: read the
//! tokens up to the cursor and keep the open lists, each with its parts so far. A section's keyword in a
//! place where no section can be closes the lists that were left open, as in the parser.

use pddl::syntax::{self, TokenKind};
use pddl::{Source, Span};

use crate::describe::{flat, typed};

/// Keywords of a domain's sections: they stand directly in a `define`.
pub(crate) const DOMAIN_SECTIONS: &[&str] = &[
    ":requirements",
    ":import",
    ":types",
    ":constants",
    ":predicates",
    ":functions",
    ":action",
    ":durative-action",
    ":derived",
    ":process",
    ":event",
    ":task",
    ":method",
    ":writes",
    ":constraints",
    ":invariant",
];

/// Keywords of a problem's sections.
pub(crate) const PROBLEM_SECTIONS: &[&str] =
    &[":domain", ":requirements", ":objects", ":htn", ":init", ":goal", ":constraints", ":metric"];

/// A word or a closed list.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Item<'t> {
    /// `None` for a list.
    pub(crate) word: Option<(TokenKind, &'t str)>,
    pub(crate) span: Span,
}

impl<'t> Item<'t> {
    pub(crate) fn text(&self) -> &'t str {
        self.word.map_or("", |(_, text)| text)
    }

    pub(crate) fn is(&self, word: &str) -> bool {
        self.text().eq_ignore_ascii_case(word)
    }

    pub(crate) fn is_keyword(&self) -> bool {
        self.word.is_some_and(|(kind, _)| kind == TokenKind::Keyword)
    }
}

/// A list that is open at the cursor.
#[derive(Clone, Debug)]
pub(crate) struct Open<'t> {
    pub(crate) start: u32,
    pub(crate) items: Vec<Item<'t>>,
}

impl<'t> Open<'t> {
    pub(crate) fn head(&self) -> &'t str {
        self.items.first().map_or("", Item::text)
    }

    pub(crate) fn is_headed(&self, word: &str) -> bool {
        self.head().eq_ignore_ascii_case(word)
    }

    /// Whether a type is expected next.
    pub(crate) fn expects_type(&self) -> bool {
        self.is_headed("either") || self.items.last().is_some_and(|item| item.is("-"))
    }

    /// The last key before the cursor.
    pub(crate) fn key(&self) -> &'t str {
        self.items.iter().skip(1).rev().find(|item| item.is_keyword()).map_or("", Item::text)
    }
}

/// The text behind the cursor's word on its line.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum After {
    /// Empty.
    Open,
    /// A closing parenthesis; the editor may have inserted it with the opening one.
    Closed,
    /// Other text, which belongs to the word.
    Arguments,
}

/// A cursor with its context.
#[derive(Clone, Debug)]
pub(crate) struct Context<'t> {
    source: &'t Source,
    /// The lists around it, outermost first.
    pub(crate) open: Vec<Open<'t>>,
    /// The word that it is in or behind; may be empty.
    pub(crate) word: Span,
}

impl<'t> Context<'t> {
    /// The context of a position; `None` inside a comment.
    pub(crate) fn of(source: &'t Source, offset: u32) -> Option<Self> {
        let (tree, _) = syntax::parse(source);
        let mut context = Self { source, open: Vec::new(), word: Span::new(offset, offset) };
        for (kind, span) in tree.tokens() {
            if span.start >= offset {
                break;
            }
            let text = source.slice(span);
            let ends_here = offset <= span.end;
            match kind {
                TokenKind::Whitespace => {}
                TokenKind::Comment if ends_here => return None,
                TokenKind::Comment => {}
                TokenKind::Open => context.open.push(Open { start: span.start, items: Vec::new() }),
                TokenKind::Close => context.close(span.end),
                TokenKind::Name | TokenKind::Variable | TokenKind::Keyword | TokenKind::Number => {
                    if ends_here && text != "-" {
                        context.word = span;
                    } else {
                        context.push(kind, text, span);
                    }
                }
            }
        }
        Some(context)
    }

    fn close(&mut self, end: u32) {
        if let Some(list) = self.open.pop()
            && let Some(around) = self.open.last_mut()
        {
            around.items.push(Item { word: None, span: Span::new(list.start, end) });
        }
    }

    fn push(&mut self, kind: TokenKind, text: &'t str, span: Span) {
        let depth = self.open.len();
        let is_section =
            || DOMAIN_SECTIONS.iter().chain(PROBLEM_SECTIONS).any(|s| s.eq_ignore_ascii_case(text));
        if depth > 2 && kind == TokenKind::Keyword && self.open[depth - 1].items.is_empty() && is_section() {
            self.open.drain(1..depth - 1);
        }
        if let Some(list) = self.open.last_mut() {
            list.items.push(Item { word: Some((kind, text)), span });
        }
    }

    /// The text behind the word on its line.
    pub(crate) fn after(&self) -> After {
        let rest = self.source.text().get(self.word.end as usize..).unwrap_or("");
        match rest.lines().next().unwrap_or("").trim_start().chars().next() {
            None | Some(';') => After::Open,
            Some(')') => After::Closed,
            Some(_) => After::Arguments,
        }
    }

    /// The innermost list.
    pub(crate) fn inner(&self) -> Option<&Open<'t>> {
        self.open.last()
    }

    /// The list around the innermost one.
    pub(crate) fn outer(&self) -> Option<&Open<'t>> {
        self.open.len().checked_sub(2).map(|i| &self.open[i])
    }

    /// The section around the cursor.
    pub(crate) fn section(&self) -> Option<&Open<'t>> {
        self.open.get(1)
    }

    /// The visible variables with the names of their types, innermost first.
    pub(crate) fn variables(&self) -> Vec<(String, Vec<String>)> {
        let mut lists: Vec<Span> = Vec::new();
        for (depth, list) in self.open.iter().enumerate() {
            let is_list =
                |i: usize| list.items.get(i).filter(|item| item.word.is_none()).map(|item| item.span);
            if depth == 1 {
                for pair in list.items.windows(2) {
                    let binds = [":parameters", ":results", ":vars"].iter().any(|key| pair[0].is(key));
                    if binds && pair[1].word.is_none() {
                        lists.push(pair[1].span);
                    }
                }
                if list.is_headed(":derived") {
                    lists.extend(is_list(1));
                }
            }
            if list.is_headed("forall") || list.is_headed("exists") {
                lists.extend(is_list(1));
            }
        }
        let mut found: Vec<(String, Vec<String>)> = Vec::new();
        for span in lists.into_iter().rev() {
            for (name, types) in self.typed_variables(span) {
                if found.iter().all(|(known, _)| *known != name) {
                    found.push((name, types));
                }
            }
        }
        found
    }

    fn typed_variables(&self, list: Span) -> Vec<(String, Vec<String>)> {
        let source = Source::new("", self.source.slice(list));
        let (tree, _) = syntax::parse(&source);
        let Some(list) = tree.roots().next() else { return Vec::new() };
        let items = typed(list.children()).into_iter().filter(|(item, _)| item.text().starts_with('?'));
        let names = |types: Option<syntax::Node<'_>>| match types {
            Some(list) if list.is_list() => list.children().skip(1).map(flat).collect(),
            Some(name) => vec![name.text().to_owned()],
            None => vec!["object".to_owned()],
        };
        items.map(|(item, types)| (item.text().to_owned(), names(types))).collect()
    }
}
