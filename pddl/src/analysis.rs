//! A file as an editor wants it: a draft of its model even while it is wrong, and where each name stands.
//!
//! Problem: an author asks what a name means while the file does not parse. Idea: reading never stops at an
//! error, so the model it leaves is handed out as a *draft*: its ids are in range, what could not be resolved is
//! missing from it. On the way every name that is read is kept as an [`Occurrence`]. Invariant: a draft whose
//! [`Analysis::sound`] is true is the model that `parse_*` gives. Cost: that of `parse_*` and 56 bytes a name;
//! `parse_*` itself keeps none.

use crate::lower::{self, Lowered, Sink};
use crate::model::{Domain, Name, Problem};
use crate::{Diagnostic, Plan, Source, Span, syntax};

/// What came of reading a source for an editor.
#[derive(Clone, Debug)]
pub struct Analysis<M> {
    /// The model as far as it could be read.
    pub draft: M,
    /// Whether the draft is the whole meaning of the file.
    pub sound: bool,
    /// Everything to say about it, in order of place.
    pub diagnostics: Vec<Diagnostic>,
    /// Where names stand, in order of place.
    pub occurrences: Vec<Occurrence>,
}

/// What a name is a name of.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum NameKind {
    /// A domain.
    Domain,
    /// A problem.
    Problem,
    /// A requirement flag, with its colon.
    Requirement,
    /// A type.
    Type,
    /// A predicate.
    Predicate,
    /// A function.
    Function,
    /// A constant or an object.
    Object,
    /// A variable, without the question mark.
    Variable,
    /// An action, durative or not.
    Action,
    /// A compound task.
    Task,
    /// A method.
    Method,
    /// A subtask's id.
    Subtask,
    /// A preference.
    Preference,
    /// A process.
    Process,
    /// An event.
    Event,
    /// A skill that a rule calls.
    Skill,
    /// An agent that `:writes` names.
    Agent,
}

impl std::fmt::Display for NameKind {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(match self {
            Self::Domain => "domain",
            Self::Problem => "problem",
            Self::Requirement => "requirement",
            Self::Type => "type",
            Self::Predicate => "predicate",
            Self::Function => "function",
            Self::Object => "object",
            Self::Variable => "variable",
            Self::Action => "action",
            Self::Task => "task",
            Self::Method => "method",
            Self::Subtask => "subtask",
            Self::Preference => "preference",
            Self::Process => "process",
            Self::Event => "event",
            Self::Skill => "skill",
            Self::Agent => "agent",
        })
    }
}

/// What a name stands for.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct Symbol {
    /// What it is a name of.
    pub kind: NameKind,
    /// The name.
    pub name: Name,
    /// The list outside of which a variable or a subtask's id means nothing: the section for parameters, the
    /// quantifier for what it binds. `None` for all other kinds.
    pub scope: Option<Span>,
}

/// What an occurrence does.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Role {
    /// It says that there is such a thing.
    Declaration,
    /// It names the thing.
    Use,
}

/// A name where it stands.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Occurrence {
    /// The name itself; of a variable with its question mark.
    pub span: Span,
    /// What it stands for. Nothing may have declared it.
    pub symbol: Symbol,
    /// What it does here.
    pub role: Role,
}

/// Whether occurrences are kept; a file of a million facts has millions of them.
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

/// Reads a domain (or vocabulary, rules, perception, methods), whatever is wrong with it or with the domains
/// that it imports.
pub fn analyze_domain(source: &Source, imports: &[&Domain], names: Names) -> Analysis<Domain> {
    let (tree, diagnostics) = syntax::parse(source);
    finish(lower::domain(names.sink(diagnostics), &tree, imports), nothing_declared)
}

/// Reads a problem of `domain`, which may be a draft. Without a domain only what the problem itself can tell is
/// in it.
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

/// The problem in which nothing is and nothing shall be.
fn nothing_to_do(domain: &Domain) -> Problem {
    let source = Source::new("", "(define (problem nothing))");
    let (tree, diagnostics) = syntax::parse(&source);
    lower::problem(Sink::new(diagnostics), &tree, domain).draft.expect("the text defines a problem")
}
