//! From text to model: the entry points.

use crate::model::{Domain, Problem};
use crate::{Diagnostic, Plan, Source};

/// What came of reading a source.
#[derive(Clone, Debug)]
pub struct Parsed<M> {
    /// The model; `None` if there was an error.
    pub model: Option<M>,
    /// Everything to say about it, in order of place.
    pub diagnostics: Vec<Diagnostic>,
}

/// Reads a domain (or vocabulary, rules, perception, methods). `imports` are the domains that an
/// `(:import …)` may name.
pub fn parse_domain(source: &Source, imports: &[&Domain]) -> Parsed<Domain> {
    let _ = (source, imports);
    Parsed { model: None, diagnostics: Vec::new() }
}

/// Reads a problem of `domain`.
pub fn parse_problem(source: &Source, domain: &Domain) -> Parsed<Problem> {
    let _ = (source, domain);
    Parsed { model: None, diagnostics: Vec::new() }
}

/// Reads a classical plan for `problem`.
pub fn parse_plan(source: &Source, domain: &Domain, problem: &Problem) -> Parsed<Plan> {
    let _ = (source, domain, problem);
    Parsed { model: None, diagnostics: Vec::new() }
}
