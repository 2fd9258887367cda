//! The collector of diagnostics during lowering.

use crate::diagnostic::{Diagnostic, DiagnosticKind, Label, UnsupportedFeature};
use crate::model::Name;
use crate::occurrence::{NameKind, Occurrence, Role, Symbol};
use crate::syntax::Node;
use diagnostics::{Severity, Span, nearest};

/// Most searches for a similar name in one run: each compares every declared name.
const MAX_SUGGESTIONS: usize = 64;

/// Longest excerpt of unexpected text, in characters.
const MAX_FOUND: usize = 40;

/// Collects diagnostics and, on request, occurrences of names.
#[derive(Default)]
pub(crate) struct Sink {
    diagnostics: Vec<Diagnostic>,
    suggestions: usize,
    occurrences: Option<Vec<Occurrence>>,
}

impl Sink {
    pub(crate) fn new(diagnostics: Vec<Diagnostic>) -> Self {
        Self { diagnostics, suggestions: 0, occurrences: None }
    }

    /// A sink that records occurrences of names as well.
    pub(crate) fn recording(diagnostics: Vec<Diagnostic>) -> Self {
        Self { occurrences: Some(Vec::new()), ..Self::new(diagnostics) }
    }

    /// `node` declares that name; free of cost unless occurrences are recorded.
    pub(crate) fn declare(&mut self, kind: NameKind, node: Node<'_>, scope: Option<Span>) {
        self.record(kind, node, scope, Role::Declaration);
    }

    /// `node` is a use of that name.
    pub(crate) fn mention(&mut self, kind: NameKind, node: Node<'_>, scope: Option<Span>) {
        self.record(kind, node, scope, Role::Use);
    }

    fn record(&mut self, kind: NameKind, node: Node<'_>, scope: Option<Span>, role: Role) {
        if let Some(occurrences) = &mut self.occurrences {
            let text = node.text();
            let name = Name::new(text.strip_prefix('?').unwrap_or(text));
            occurrences.push(Occurrence { span: node.span(), symbol: Symbol { kind, name, scope }, role });
        }
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

    /// `owner` lacks a part; the diagnostic is placed at the first word of `node`.
    pub(crate) fn missing(&mut self, node: Node<'_>, owner: impl Into<String>, what: &'static str) {
        self.report(first_word(node), DiagnosticKind::Missing { owner: owner.into(), what });
    }

    /// The name among `candidates` that is most similar to `name`, if one is near enough.
    pub(crate) fn suggest<'a>(
        &mut self,
        name: &str,
        candidates: impl IntoIterator<Item = &'a str>,
    ) -> Option<String> {
        self.suggestions += 1;
        if self.suggestions > MAX_SUGGESTIONS { None } else { nearest(name, candidates) }
    }

    /// The number of diagnostics so far.
    pub(crate) fn count(&self) -> usize {
        self.diagnostics.len()
    }

    /// Sorts the diagnostics by place and removes duplicates; decides whether the model is sound.
    pub(crate) fn finish(mut self) -> Finished {
        self.diagnostics.sort_by_key(|d| (d.span.start, d.span.end));
        self.diagnostics.dedup();
        let unsupported =
            self.diagnostics.iter().filter(|d| d.severity == Severity::Unsupported).cloned().collect();
        let sound = self.diagnostics.iter().all(|d| d.severity != Severity::Error);
        let mut occurrences = self.occurrences.unwrap_or_default();
        // A `forall` around several times is read once for each time, so its names are recorded several
        // times.
        occurrences.sort_by_key(|o| (o.span.start, o.span.end));
        occurrences.dedup();
        Finished { diagnostics: self.diagnostics, unsupported, sound, occurrences }
    }
}

/// The contents of a sink.
pub(crate) struct Finished {
    pub(crate) diagnostics: Vec<Diagnostic>,
    pub(crate) unsupported: Vec<Diagnostic>,
    pub(crate) sound: bool,
    pub(crate) occurrences: Vec<Occurrence>,
}

/// A model as far as it could be read, with the sink's contents.
pub(crate) struct Lowered<M> {
    /// `None` if the file has no definition.
    pub(crate) draft: Option<M>,
    /// Whether the draft is the whole meaning of the file.
    pub(crate) sound: bool,
    pub(crate) diagnostics: Vec<Diagnostic>,
    pub(crate) occurrences: Vec<Occurrence>,
}

impl<M> Lowered<M> {
    pub(crate) fn new(draft: Option<M>, finished: Finished) -> Self {
        let Finished { diagnostics, sound, occurrences, .. } = finished;
        Self { draft, sound, diagnostics, occurrences }
    }
}

/// The node's text, short enough for a sentence.
pub(super) fn found(node: Node<'_>) -> String {
    found_text(node.text())
}

/// A text, short enough for a sentence.
pub(super) fn found_text(text: &str) -> String {
    if text == "()" {
        return "`()`".into();
    }
    // Lists can be as long as the file: only the beginning is read.
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
