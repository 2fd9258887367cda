//! The lossless tree: tokens that tile the text, and nodes over them.
//!
//! Nodes lie in preorder in one array. A node knows where its subtree ends, so its first child is the next
//! node and its next sibling starts at the subtree's end. 16 bytes a node, no pointers, no recursive drop.
//! Comments and blanks are in [`Tree::tokens`] only.

use super::tokens::Tokens;
use crate::Span;

/// The kind of a node.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum NodeKind {
    /// `( … )`
    List,
    /// A name or operator.
    Name,
    /// `?name`
    Variable,
    /// `:name`
    Keyword,
    /// A number.
    Number,
}

#[derive(Clone, Copy, Debug)]
pub(super) struct NodeData {
    pub(super) kind: NodeKind,
    pub(super) span: Span,
    /// One past the last node of the subtree.
    pub(super) end: u32,
}

/// A text with its structure.
#[derive(Clone, Debug)]
pub struct Tree<'s> {
    pub(super) text: &'s str,
    pub(super) nodes: Vec<NodeData>,
}

impl<'s> Tree<'s> {
    /// Every token, comments and blanks included.
    pub fn tokens(&self) -> Tokens<'s> {
        Tokens::of(self.text)
    }

    /// The source, rebuilt from the tokens: equal to it byte for byte.
    pub fn text(&self) -> String {
        self.tokens().map(|(_, span)| &self.text[span.range()]).collect()
    }

    /// The top-level nodes.
    pub fn roots<'t>(&'t self) -> Children<'t>
    where
        's: 't,
    {
        let end = u32::try_from(self.nodes.len()).expect("fewer nodes than bytes, which are less than 4 GiB");
        Children { tree: self, next: 0, end }
    }
}

/// A node of a tree.
#[derive(Clone, Copy)]
pub struct Node<'t> {
    tree: &'t Tree<'t>,
    id: u32,
}

impl<'t> Node<'t> {
    fn data(self) -> &'t NodeData {
        &self.tree.nodes[self.id as usize]
    }

    /// What it is.
    pub fn kind(self) -> NodeKind {
        self.data().kind
    }

    /// Where it is.
    pub fn span(self) -> Span {
        self.data().span
    }

    /// As written.
    pub fn text(self) -> &'t str {
        &self.tree.text[self.span().range()]
    }

    /// Whether it is `( … )`.
    pub fn is_list(self) -> bool {
        self.kind() == NodeKind::List
    }

    /// Whether it is that word; case is ignored.
    pub fn is(self, word: &str) -> bool {
        !self.is_list() && self.text().eq_ignore_ascii_case(word)
    }

    /// Whether it can be a name: `5` and `-` can, `?x`, `:x` and lists cannot.
    pub fn is_name(self) -> bool {
        matches!(self.kind(), NodeKind::Name | NodeKind::Number)
    }

    /// The children of a list; none for atoms.
    pub fn children(self) -> Children<'t> {
        Children { tree: self.tree, next: self.id + 1, end: self.data().end }
    }

    /// The first child.
    pub fn head(self) -> Option<Node<'t>> {
        self.children().next()
    }

    /// Whether it is a list that starts with that word.
    pub fn is_headed(self, word: &str) -> bool {
        self.head().is_some_and(|h| h.is(word))
    }
}

impl std::fmt::Debug for Node<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{:?} {:?}", self.kind(), self.text())
    }
}

/// Siblings from left to right.
#[derive(Clone)]
pub struct Children<'t> {
    tree: &'t Tree<'t>,
    next: u32,
    end: u32,
}

impl<'t> Iterator for Children<'t> {
    type Item = Node<'t>;
    fn next(&mut self) -> Option<Node<'t>> {
        (self.next < self.end).then(|| {
            let node = Node { tree: self.tree, id: self.next };
            self.next = node.data().end;
            node
        })
    }
}
