//! Tokens to tree, whatever the parentheses do.
//!
//! One pass with an explicit stack of open lists. Problem: after one wrong parenthesis everything
//! behind it would be nested wrongly and all its errors lost. Idea: a list that starts with a
//! section's keyword (`(:action`) can only stand directly inside `(define`. If it comes deeper, the
//! lists between were never closed: they are reported at their opening parentheses and end there. If
//! it comes after `define` was closed, a parenthesis too many was written: that one is reported and
//! `define` goes on. Lists deeper than [`MAX_DEPTH`] get no nodes, so that whoever recurses over a
//! tree is safe. Invariant: nodes are in preorder and every parent's range covers its children's.

use super::token::{TokenKind, Tokens};
use super::tree::{NodeData, NodeKind, Tree};
use crate::diagnostic::{Diagnostic, DiagnosticKind};
use crate::{Source, Span};

/// Deepest nesting that gets nodes.
pub const MAX_DEPTH: usize = 1000;

/// Room for nodes is made for a text that has one in so many bytes; few have less.
const BYTES_PER_NODE: usize = 8;

/// Most reports of one kind of imbalance, so that a binary file does not flood its reader.
const MAX_REPORTS: usize = 20;

/// Keywords of lists that stand directly in `(define …)`.
const SECTIONS: &[&str] = &[
    ":action",
    ":constants",
    ":constraints",
    ":derived",
    ":domain",
    ":durative-action",
    ":event",
    ":functions",
    ":goal",
    ":htn",
    ":import",
    ":init",
    ":method",
    ":metric",
    ":objects",
    ":predicates",
    ":process",
    ":requirements",
    ":task",
    ":types",
    ":writes",
];

/// The tree of a source, and what is wrong with its parentheses.
pub fn parse(source: &Source) -> (Tree<'_>, Vec<Diagnostic>) {
    let text = source.text();
    let nodes = Vec::with_capacity(text.len() / BYTES_PER_NODE);
    let mut builder = Builder { text, nodes, ..Builder::default() };
    for (kind, span) in Tokens::of(text) {
        builder.token(kind, span);
    }
    builder.finish();
    (Tree { text, nodes: builder.nodes }, builder.diagnostics)
}

#[derive(Default)]
struct Builder<'s> {
    text: &'s str,
    nodes: Vec<NodeData>,
    /// Open lists that have nodes, outermost first.
    stack: Vec<u32>,
    /// How many open lists are too deep to have one.
    too_deep: usize,
    /// End of the last token that is neither blank nor comment.
    last_end: u32,
    /// The same before the last opening parenthesis.
    before_open: u32,
    /// The `(define …)` that was closed last, and the parenthesis that closed it.
    closed_define: Option<(u32, Span)>,
    unclosed: usize,
    unmatched: usize,
    diagnostics: Vec<Diagnostic>,
}

impl Builder<'_> {
    fn token(&mut self, kind: TokenKind, span: Span) {
        match kind {
            TokenKind::Whitespace | TokenKind::Comment => return,
            TokenKind::Open => self.open(span),
            TokenKind::Close => self.close(span),
            TokenKind::Name => self.atom(NodeKind::Name, span),
            TokenKind::Variable => self.atom(NodeKind::Variable, span),
            TokenKind::Number => self.atom(NodeKind::Number, span),
            TokenKind::Keyword => {
                self.recover(span);
                self.atom(NodeKind::Keyword, span);
            }
        }
        self.last_end = span.end;
    }

    fn next_id(&self) -> u32 {
        u32::try_from(self.nodes.len()).expect("a source of less than 4 GiB has less than 2^32 nodes")
    }

    fn open(&mut self, span: Span) {
        self.before_open = self.last_end;
        if self.stack.len() >= MAX_DEPTH {
            if self.too_deep == 0 && !self.diagnostics.iter().any(|d| d.code() == "E0103") {
                self.report(span, DiagnosticKind::NestingTooDeep { limit: MAX_DEPTH });
            }
            self.too_deep += 1;
            return;
        }
        self.stack.push(self.next_id());
        self.nodes.push(NodeData { kind: NodeKind::List, span, end: self.next_id() + 1 });
    }

    fn close(&mut self, span: Span) {
        if self.too_deep > 0 {
            self.too_deep -= 1;
            return;
        }
        let Some(id) = self.stack.pop() else {
            self.unmatched += 1;
            if self.unmatched <= MAX_REPORTS {
                self.report(span, DiagnosticKind::UnmatchedParenthesis);
            }
            return;
        };
        self.end_list(id, span.end, self.next_id());
        if self.stack.is_empty() && self.is_define(id) {
            self.closed_define = Some((id, span));
        }
    }

    fn atom(&mut self, kind: NodeKind, span: Span) {
        if self.too_deep == 0 {
            let end = self.next_id() + 1;
            self.nodes.push(NodeData { kind, span, end });
        }
    }

    fn end_list(&mut self, id: u32, text_end: u32, node_end: u32) {
        let node = &mut self.nodes[id as usize];
        node.span.end = text_end;
        node.end = node_end;
    }

    fn is_define(&self, id: u32) -> bool {
        self.nodes.get(id as usize + 1).is_some_and(|head| {
            head.kind == NodeKind::Name && self.text[head.span.range()].eq_ignore_ascii_case("define")
        })
    }

    /// `span` is a keyword that was just read: puts its list directly under `define` if it is a section.
    fn recover(&mut self, span: Span) {
        let Some(&list) = self.stack.last() else { return };
        let starts_list = self.too_deep == 0 && list + 1 == self.next_id();
        if !starts_list || self.stack.len() == 2 || !is_section(&self.text[span.range()]) {
            return;
        }
        if self.stack.len() > 2 && self.is_define(self.stack[0]) {
            let between: Vec<u32> = self.stack.drain(1..self.stack.len() - 1).collect();
            self.unclosed(&between, self.before_open, list);
        } else if self.stack.len() == 1
            && let Some((define, closed_by)) = self.closed_define
        {
            self.unmatched += 1;
            self.report(closed_by, DiagnosticKind::UnmatchedParenthesis);
            self.stack.insert(0, define);
            self.closed_define = None;
        }
    }

    /// Ends lists that were never closed.
    fn unclosed(&mut self, lists: &[u32], text_end: u32, node_end: u32) {
        for &id in lists.iter().rev() {
            let start = self.nodes[id as usize].span.start;
            self.end_list(id, text_end, node_end);
            self.unclosed += 1;
            if self.unclosed <= MAX_REPORTS {
                self.report(Span::new(start, start + 1), DiagnosticKind::UnclosedParenthesis);
            }
        }
    }

    fn finish(&mut self) {
        let open = std::mem::take(&mut self.stack);
        self.unclosed(&open, self.last_end, self.next_id());
    }

    fn report(&mut self, span: Span, kind: DiagnosticKind) {
        self.diagnostics.push(Diagnostic::new(span, kind));
    }
}

fn is_section(keyword: &str) -> bool {
    SECTIONS.iter().any(|s| s.eq_ignore_ascii_case(keyword))
}
