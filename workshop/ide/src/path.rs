//! The path from the top of a file down to a place: the lists that enclose it.

use pddl::Span;
use pddl::syntax::{Node, NodeKind, Tree};

/// The nodes that enclose `offset` (or end there), outermost first; a word at the end.
pub(crate) fn path<'t>(tree: &'t Tree<'t>, offset: u32) -> Vec<Node<'t>> {
    let mut way: Vec<Node<'t>> = Vec::new();
    let mut siblings = tree.roots();
    loop {
        let around = |n: &Node<'t>| n.span().start <= offset && offset <= n.span().end;
        // Between a list that ends here and a word that starts here, the later one counts.
        let next = siblings.by_ref().take_while(|n| n.span().start <= offset).filter(around).last();
        let Some(next) = next else { return way };
        let inside = next.is_list()
            && (next.span().start < offset && offset < next.span().end
                || next.span().end == offset && !ends_closed(next));
        way.push(next);
        if !inside {
            return way;
        }
        siblings = next.children();
    }
}

fn ends_closed(list: Node<'_>) -> bool {
    list.text().ends_with(')')
}

/// The context of a name: the section around it, its key, and the lists between.
#[derive(Clone, Debug)]
pub(crate) struct Spot<'t> {
    /// The section that holds the name, such as `(:action …)`.
    pub(crate) section: Node<'t>,
    /// The key before the part that holds it, such as `:effect`.
    pub(crate) key: Option<Node<'t>>,
    /// The lists between the section and the name, outermost first.
    pub(crate) lists: Vec<Node<'t>>,
}

impl<'t> Spot<'t> {
    /// The spot of the name at `span`, if it is in a section.
    pub(crate) fn of(tree: &'t Tree<'t>, span: Span) -> Option<Self> {
        let way = path(tree, span.start);
        let is_section = |n: &Node<'_>| n.head().is_some_and(|h| h.kind() == NodeKind::Keyword);
        let position = way.iter().position(is_section)?;
        let section = way[position];
        let lists: Vec<Node<'t>> = way[position + 1..].iter().copied().filter(|n| n.is_list()).collect();
        let part = way.get(position + 1)?.span().start;
        let before = section.children().skip(1).take_while(|n| n.span().start < part);
        let key = before.filter(|n| n.kind() == NodeKind::Keyword).last();
        Some(Self { section, key, lists })
    }

    /// The section's keyword, such as `:action`.
    pub(crate) fn keyword(&self) -> &'t str {
        self.section.head().map_or("", Node::text)
    }

    /// The name that the section defines, if it defines one.
    pub(crate) fn name(&self) -> Option<Node<'t>> {
        self.section.children().nth(1).filter(|n| n.is_name())
    }

    /// Whether the key is that one.
    pub(crate) fn has_key(&self, key: &str) -> bool {
        self.key.is_some_and(|k| k.is(key))
    }
}
