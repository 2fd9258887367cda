//! Sections and keys of a file as they are written, for lints about what no model keeps.

use pddl::syntax::{Node, NodeKind, Tree};
use pddl::{FileKind, Span};

/// The definition of that kind.
pub(crate) fn definition<'t>(tree: &'t Tree<'_>, kind: FileKind) -> Option<Node<'t>> {
    let word = kind.to_string();
    tree.roots().find(|root| {
        (root.is_headed("define") || root.is_headed("defdomain"))
            && root.children().nth(1).is_some_and(|head| head.is_headed(&word))
    })
}

/// The sections of the definition of that kind: `(:types …)`, `(:action …)` …
pub(crate) fn sections<'t>(tree: &'t Tree<'_>, kind: FileKind) -> impl Iterator<Item = Node<'t>> {
    let parts = definition(tree, kind).into_iter().flat_map(|d| d.children().skip(2));
    parts.filter(|part| part.head().is_some_and(|head| head.kind() == NodeKind::Keyword))
}

/// What stands behind a key: `(…)` for `:effect (…)`.
pub(crate) fn value<'t>(section: Node<'t>, key: &str) -> Option<Node<'t>> {
    section.children().skip_while(|child| !child.is(key)).nth(1)
}

/// The opening parenthesis and the first word of a list, or the whole atom.
pub(crate) fn first_word(node: Node<'_>) -> Span {
    match node.head() {
        Some(head) if !head.is_list() => Span::new(node.span().start, head.span().end),
        _ if node.is_list() => Span::new(node.span().start, node.span().start + 1),
        _ => node.span(),
    }
}
