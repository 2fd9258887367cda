//! Where diagnostics go while a model is made.

use crate::diagnostic::{Diagnostic, DiagnosticKind, Label, UnsupportedFeature, nearest};
use crate::syntax::Node;
use crate::{Severity, Span};

/// Most searches for a similar name in one run: each looks at every declared name.
const MAX_SUGGESTIONS: usize = 64;

/// Longest excerpt of what was found instead, in characters.
const MAX_FOUND: usize = 40;

/// Collects diagnostics.
#[derive(Default)]
pub(crate) struct Sink {
    diagnostics: Vec<Diagnostic>,
    suggestions: usize,
}

impl Sink {
    pub(crate) fn new(diagnostics: Vec<Diagnostic>) -> Self {
        Self { diagnostics, suggestions: 0 }
    }

    pub(crate) fn report(&mut self, span: Span, kind: DiagnosticKind) {
        self.diagnostics.push(Diagnostic::new(span, kind));
    }

    pub(crate) fn report_with(&mut self, span: Span, kind: DiagnosticKind, at: Span, label: Label) {
        self.diagnostics.push(Diagnostic::new(span, kind).with_label(at, label));
    }

    pub(crate) fn unsupported(&mut self, span: Span, feature: UnsupportedFeature) {
        self.report(span, DiagnosticKind::Unsupported { feature });
    }

    /// `node` stands where `expected` should.
    pub(crate) fn unexpected(&mut self, node: Node<'_>, expected: &'static str) {
        self.report(node.span(), DiagnosticKind::Unexpected { found: found(node), expected });
    }

    /// `owner` lacks something; its place is that of its first word.
    pub(crate) fn missing(&mut self, node: Node<'_>, owner: impl Into<String>, what: &'static str) {
        self.report(first_word(node), DiagnosticKind::Missing { owner: owner.into(), what });
    }

    /// The name among `candidates` that `name` may have been meant to be.
    pub(crate) fn suggest<'a>(
        &mut self,
        name: &str,
        candidates: impl IntoIterator<Item = &'a str>,
    ) -> Option<String> {
        self.suggestions += 1;
        if self.suggestions > MAX_SUGGESTIONS { None } else { nearest(name, candidates) }
    }

    /// How many so far; with [`Sink::since`] this tells whether a part had something to say.
    pub(crate) fn count(&self) -> usize {
        self.diagnostics.len()
    }

    /// What was reported since [`Sink::count`] was `count`.
    pub(crate) fn since(&self, count: usize) -> &[Diagnostic] {
        &self.diagnostics[count..]
    }

    /// Everything in order of place, each once, and what of it is unsupported; whether a model may be made.
    pub(crate) fn finish(mut self) -> Finished {
        self.diagnostics.sort_by_key(|d| (d.span.start, d.span.end));
        self.diagnostics.dedup();
        let unsupported =
            self.diagnostics.iter().filter(|d| d.severity == Severity::Unsupported).cloned().collect();
        let sound = self.diagnostics.iter().all(|d| d.severity != Severity::Error);
        Finished { diagnostics: self.diagnostics, unsupported, sound }
    }
}

/// All that a sink has collected.
pub(crate) struct Finished {
    pub(crate) diagnostics: Vec<Diagnostic>,
    pub(crate) unsupported: Vec<Diagnostic>,
    pub(crate) sound: bool,
}

/// The node's text, short enough for a sentence.
pub(super) fn found(node: Node<'_>) -> String {
    let text = node.text();
    if text == "()" {
        return "`()`".into();
    }
    // Lists can be as long as the file: only their beginning is looked at.
    let start: String = text.chars().take(4 * MAX_FOUND).collect();
    let mut words = start.split_whitespace().collect::<Vec<_>>().join(" ");
    if words.chars().count() > MAX_FOUND {
        words = words.chars().take(MAX_FOUND - 1).chain(['…']).collect();
    }
    format!("`{words}`")
}

/// The opening parenthesis and the first word of a list, or the whole atom.
pub(super) fn first_word(node: Node<'_>) -> Span {
    match node.head() {
        Some(head) if !head.is_list() => Span::new(node.span().start, head.span().end),
        Some(_) | None if node.is_list() => Span::new(node.span().start, node.span().start + 1),
        _ => node.span(),
    }
}
