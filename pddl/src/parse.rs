//! From text to model: the entry points.

use crate::lower::{self, Lowered, Sink};
use crate::model::{Domain, Problem};
use crate::syntax;
use crate::{Diagnostic, Plan, Severity, Source};

/// The result of reading a source.
#[derive(Clone, Debug)]
pub struct Parsed<M> {
    /// The model; `None` if there was an error.
    pub model: Option<M>,
    /// All findings, in order of place.
    pub diagnostics: Vec<Diagnostic>,
}

impl<M> Parsed<M> {
    /// The errors only.
    pub fn errors(&self) -> impl Iterator<Item = &Diagnostic> {
        self.diagnostics.iter().filter(|d| d.severity == Severity::Error)
    }
}

/// Reads a domain (or vocabulary, rules, perception, methods). `imports` are the domains that an
/// `(:import …)` may name.
pub fn parse_domain(source: &Source, imports: &[&Domain]) -> Parsed<Domain> {
    let (tree, diagnostics) = syntax::parse(source);
    parsed(lower::domain(Sink::new(diagnostics), &tree, imports))
}

/// Reads a problem of `domain`.
pub fn parse_problem(source: &Source, domain: &Domain) -> Parsed<Problem> {
    let (tree, diagnostics) = syntax::parse(source);
    parsed(lower::problem(Sink::new(diagnostics), &tree, domain))
}

/// Reads a plan for `problem`; the text decides whether it is sequential, temporal or hierarchical.
pub fn parse_plan(source: &Source, domain: &Domain, problem: &Problem) -> Parsed<Plan> {
    parsed(lower::plan(Sink::new, source, domain, problem))
}

/// The model, unless there was an error.
fn parsed<M>(lowered: Lowered<M>) -> Parsed<M> {
    Parsed { model: lowered.draft.filter(|_| lowered.sound), diagnostics: lowered.diagnostics }
}
