//! Reading a file for an editor: a draft of its model even while it has errors, and the place of each name.
//!
//! Problem: an author asks what a name means while the file does not parse. Idea: reading never stops at an
//! error, so the model that results is handed out as a *draft*. Its ids are in range; what could not be
//! resolved is left out. Every name on the way is recorded as an [`Occurrence`]. Invariant: a draft whose
//! [`Analysis::sound`] is true equals the model that `parse_*` gives. Cost: that of `parse_*` plus 56 bytes
//! a name; `parse_*` itself records no names.

use crate::lower::{self, Lowered, Sink};
use crate::model::{Domain, Problem};
use crate::occurrence::Occurrence;
use crate::{Diagnostic, Plan, Source, syntax};

/// The result of reading a source for an editor.
#[derive(Clone, Debug)]
pub struct Analysis<M> {
    /// The model as far as it could be read.
    pub draft: M,
    /// Whether the draft is the whole meaning of the file.
    pub sound: bool,
    /// All findings, in order of place.
    pub diagnostics: Vec<Diagnostic>,
    /// Where names stand, in order of place; empty with [`Names::Skipped`].
    pub occurrences: Vec<Occurrence>,
}

/// Whether occurrences are recorded; a file of a million facts has millions of them.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Names {
    /// All of them.
    #[default]
    Kept,
    /// None: [`Analysis::occurrences`] is empty.
    Skipped,
}

impl Names {
    fn sink(self, diagnostics: Vec<Diagnostic>) -> Sink {
        match self {
            Self::Kept => Sink::recording(diagnostics),
            Self::Skipped => Sink::new(diagnostics),
        }
    }
}

/// Reads a domain (or vocabulary, rules, perception, methods), also if it or a domain that it imports has
/// errors.
pub fn analyze_domain(source: &Source, imports: &[&Domain], names: Names) -> Analysis<Domain> {
    let (tree, diagnostics) = syntax::parse(source);
    finish(lower::domain(names.sink(diagnostics), &tree, imports), nothing_declared)
}

/// Reads a problem of `domain`, which may be a draft. Names that the domain does not declare are missing
/// from the problem's draft.
pub fn analyze_problem(source: &Source, domain: &Domain, names: Names) -> Analysis<Problem> {
    let (tree, diagnostics) = syntax::parse(source);
    finish(lower::problem(names.sink(diagnostics), &tree, domain), || nothing_to_do(domain))
}

/// Reads a plan for `problem`; both models may be drafts.
pub fn analyze_plan(source: &Source, domain: &Domain, problem: &Problem, names: Names) -> Analysis<Plan> {
    finish(lower::plan(|diagnostics| names.sink(diagnostics), source, domain, problem), Plan::default)
}

fn finish<M>(lowered: Lowered<M>, empty: impl FnOnce() -> M) -> Analysis<M> {
    let Lowered { draft, sound, diagnostics, occurrences } = lowered;
    Analysis { draft: draft.unwrap_or_else(empty), sound, diagnostics, occurrences }
}

/// The domain that declares nothing.
fn nothing_declared() -> Domain {
    let source = Source::new("", "(define (domain nothing))");
    let (tree, diagnostics) = syntax::parse(&source);
    lower::domain(Sink::new(diagnostics), &tree, &[]).draft.expect("the text defines a domain")
}

/// The problem with an empty initial state and an empty goal.
fn nothing_to_do(domain: &Domain) -> Problem {
    let source = Source::new("", "(define (problem nothing))");
    let (tree, diagnostics) = syntax::parse(&source);
    lower::problem(Sink::new(diagnostics), &tree, domain).draft.expect("the text defines a problem")
}
