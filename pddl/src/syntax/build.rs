//! Tokens to tree, whatever the parentheses do.
//!
//! Problem: after one wrong parenthesis everything behind it would be nested wrongly, and all its errors
//! would be lost.
//!
//! Idea: one pass with an explicit stack of open lists, and the rule that a list with a section's keyword
//! (`(:action`) stands directly inside `(define`.
//! - If such a list comes deeper, the lists between were never closed. They are reported at their opening
//!   parentheses and end there, or earlier if the layout of the lines shows where.
//! - If it comes after `define` was closed, there is a closing parenthesis too many. That one is reported
//!   and `define` goes on. If a key such as `:effect` stands directly in `define`, the surplus parenthesis
//!   is the one before the key.
//! - A second `(define (domain` or `(problem` ends the first.
//!
//! Parentheses that balance are never questioned. Lists deeper than [`MAX_DEPTH`] get no nodes, so that
//! recursion over a tree is safe. Invariant: nodes are in preorder and every parent's range covers its
//! children's.

use super::layout::{Signs, is_key, missing_ends};
use super::token::TokenKind;
use super::tokens::Tokens;
use super::tree::{NodeData, NodeKind, Tree};
use crate::diagnostic::{Diagnostic, DiagnosticKind, Label};
use crate::{Source, Span};

/// Deepest nesting that gets nodes; deeper lists are reported.
pub(super) const MAX_DEPTH: usize = 1000;

/// Bytes of text for each node that is allocated in advance; few texts have fewer bytes a node.
const BYTES_PER_NODE: usize = 8;

/// Most reports of one kind of imbalance, so that a binary file does not flood the output.
const MAX_REPORTS: usize = 20;

/// Keywords of lists that stand directly in `(define …)`.
const SECTIONS: &[&str] = &[
    ":action",
    ":axiom",
    ":constants",
    ":constraint",
    ":constraints",
    ":derived",
    ":domain",
    ":durative-action",
    ":event",
    ":extends",
    ":functions",
    ":goal",
    ":goal-probability",
    ":goal-reward",
    ":htn",
    ":import",
    ":init",
    ":invariant",
    ":length",
    ":method",
    ":metric",
    ":objects",
    ":predicates",
    ":process",
    ":requirements",
    ":safety",
    ":situation",
    ":task",
    ":timeless",
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
    /// How many open lists are too deep to have a node.
    too_deep: usize,
    /// End of the last token that is neither blank nor comment.
    last_end: u32,
    /// The same before the last opening parenthesis.
    before_open: u32,
    /// The `(define …)` that was closed last, and the parenthesis that closed it.
    closed_define: Option<(u32, Span)>,
    /// A section is being read for the second time.
    again: bool,
    /// Whether the columns of the sections so far match their nesting; computed on demand.
    keeps_columns: Option<bool>,
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
            TokenKind::Name => {
                self.recover_definition(span);
                self.atom(NodeKind::Name, span);
            }
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
            if self.too_deep == 0 && !self.is_too_deep() {
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
        if let (true, false, Some((define, _))) = (self.stack.is_empty(), self.again, self.closed_define) {
            self.reopen_by_key(define, span.start);
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
        self.nodes
            .get(id as usize + 1)
            .is_some_and(|head| head.kind == NodeKind::Name && self.is_word(head.span, "define"))
    }

    /// Whether lists without nodes were found.
    fn is_too_deep(&self) -> bool {
        self.diagnostics.iter().any(|d| d.code() == "E0103")
    }

    fn is_word(&self, span: Span, word: &str) -> bool {
        self.text[span.range()].eq_ignore_ascii_case(word)
    }

    /// `span` is the keyword that was just read: if it names a section, its list moves directly under
    /// `define`.
    fn recover(&mut self, span: Span) {
        let Some(&list) = self.stack.last() else { return };
        let starts_list = self.too_deep == 0 && list + 1 == self.next_id();
        if !starts_list || self.again || self.stack.len() == 2 || !is_section(&self.text[span.range()]) {
            return;
        }
        let inside = self.stack.len() > 2 && self.is_define(self.stack[0]);
        let behind = self.closed_define.filter(|_| self.stack.len() == 1);
        if !inside && behind.is_none() {
            return;
        }
        // Remove the list until the sections before it are correct.
        let start = self.take_back(list);
        if let Some((define, _)) = behind {
            self.reopen_by_key(define, start);
        } else {
            self.close_by_layout(self.stack[1], start, self.stack.len() - 1);
        }
        if let (true, Some((define, closed_by))) = (self.stack.is_empty(), self.closed_define.take()) {
            self.unmatched += 1;
            self.report(closed_by, DiagnosticKind::UnmatchedParenthesis);
            self.stack.push(define);
        }
        let between = self.stack.split_off(self.stack.len().min(1));
        self.unclosed(&between, self.last_end, self.next_id());
        self.open(Span::new(start, start + 1));
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
        self.end_all(u32::try_from(self.text.len()).expect("a source is shorter than 4 GiB"));
    }

    /// `span` is the name that was just read: if it is the `domain` of `(define (domain`, no list encloses
    /// that one.
    fn recover_definition(&mut self, span: Span) {
        let &[first, .., define, title] = self.stack.as_slice() else { return };
        let is_title =
            title + 1 == self.next_id() && title == define + 2 && self.too_deep == 0 && !self.again;
        if is_title
            && (self.is_word(span, "domain") || self.is_word(span, "problem"))
            && self.is_define(define)
            && self.is_define(first)
        {
            let [define, word, title] = [define, define + 1, title].map(|id| self.nodes[id as usize].span);
            self.stack.truncate(self.stack.len() - 2);
            self.nodes.truncate(self.nodes.len() - 3);
            self.last_end = define.start;
            self.end_all(define.start);
            self.open(define);
            self.atom(NodeKind::Name, word);
            self.open(title);
        }
    }

    /// Removes a list that has no contents yet. Returns where it starts.
    fn take_back(&mut self, list: u32) -> u32 {
        self.stack.pop();
        self.last_end = self.before_open;
        let start = self.nodes[list as usize].span.start;
        self.nodes.truncate(list as usize);
        start
    }

    /// Ends every list that is open at `end`.
    fn end_all(&mut self, end: u32) {
        let last = self.last_section();
        if let Some(section) = last {
            self.close_by_layout(section, end, self.stack.len());
        }
        let open = std::mem::take(&mut self.stack);
        let reported = self.diagnostics.len();
        self.unclosed(&open, self.last_end, self.next_id());
        if let ([_], Some(section)) = (open.as_slice(), last)
            && let Some(diagnostic) = self.diagnostics.get_mut(reported)
        {
            let start = self.nodes[section as usize].span.start;
            diagnostic.labels.push((Span::new(start, start + 1), Label::LastSection));
        }
    }

    /// The last section of a definition that is still open.
    fn last_section(&self) -> Option<u32> {
        let &define = self.stack.first().filter(|&&list| self.too_deep == 0 && self.is_define(list))?;
        if let Some(&section) = self.stack.get(1) {
            return Some(section);
        }
        let mut last = None;
        let mut next = define + 1;
        while let Some(node) = self.nodes.get(next as usize) {
            let head = self.nodes.get(next as usize + 1).filter(|_| next + 1 < node.end);
            if head.is_some_and(|head| head.kind == NodeKind::Keyword) {
                last = Some(next);
            }
            next = node.end;
        }
        last
    }

    /// Reads the section again, up to `end`, and closes at most `missing` lists where the layout shows their
    /// ends.
    fn close_by_layout(&mut self, section: u32, end: u32, missing: usize) {
        if self.unclosed >= MAX_REPORTS || self.is_too_deep() {
            return;
        }
        let span = Span::new(self.nodes[section as usize].span.start, end);
        let signs = if self.keeps_columns(section) { Signs::KeysAndColumns } else { Signs::Keys };
        let ends = missing_ends(self.text, span, missing, signs);
        if ends.is_empty() {
            return;
        }
        self.start_again(section);
        let mut ends = ends.into_iter().peekable();
        for (kind, span) in Tokens::within(self.text, span) {
            while ends.next_if_eq(&span.start).is_some() {
                // The section stays; what is too deep was not on the stack.
                if self.stack.len() > 2 && self.too_deep == 0 {
                    let list = self.stack.split_off(self.stack.len() - 1);
                    self.unclosed(&list, self.last_end, self.next_id());
                }
            }
            self.token(kind, span);
        }
        self.again = false;
    }

    /// If a key stands directly in the closed definition, the section before it was closed too early: reads that section
    /// again, up to `end`, without the parenthesis that closed it.
    fn reopen_by_key(&mut self, define: u32, end: u32) {
        if self.unmatched >= MAX_REPORTS || self.is_too_deep() {
            return;
        }
        let mut section = None;
        let mut next = define + 1;
        let until = self.nodes[define as usize].end;
        while next < until {
            let node = self.nodes[next as usize];
            match node.kind {
                NodeKind::List => section = Some((next, node.span)),
                NodeKind::Keyword if is_key(&self.text[node.span.range()]) => break,
                _ => {}
            }
            next = node.end;
        }
        let Some((section, span)) = section.filter(|_| next < until) else { return };
        self.unmatched += 1;
        let closed_by = Span::new(span.end - 1, span.end);
        self.report(closed_by, DiagnosticKind::UnmatchedParenthesis);
        self.closed_define = None;
        self.stack.push(define);
        self.start_again(section);
        for (kind, span) in Tokens::within(self.text, Span::new(span.start, end)) {
            if span != closed_by {
                self.token(kind, span);
            }
        }
        self.again = false;
    }

    /// Removes the section and everything behind it.
    fn start_again(&mut self, section: u32) {
        self.nodes.truncate(section as usize);
        self.stack.truncate(1);
        self.again = true;
    }

    /// Whether the columns of the sections before this one match their nesting.
    fn keeps_columns(&mut self, section: u32) -> bool {
        if let Some(known) = self.keeps_columns {
            return known;
        }
        let mut next = self.stack[0] + 1;
        let mut keeps = true;
        while keeps && next < section {
            let node = self.nodes[next as usize];
            let is_list = node.kind == NodeKind::List;
            keeps = !is_list || missing_ends(self.text, node.span, 1, Signs::KeysAndColumns).is_empty();
            next = node.end;
        }
        self.keeps_columns = Some(keeps);
        keeps
    }

    fn report(&mut self, span: Span, kind: DiagnosticKind) {
        self.diagnostics.push(Diagnostic::new(span, kind));
    }
}

fn is_section(keyword: &str) -> bool {
    SECTIONS.iter().any(|s| s.eq_ignore_ascii_case(keyword))
}
