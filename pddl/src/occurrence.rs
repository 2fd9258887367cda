//! Where a name stands in a file, and what it stands for there.
//!
//! Lowering records an [`Occurrence`] for each name that it reads; editors look them up.

use diagnostics::Span;

use crate::model::Name;

/// The kind of thing that a name names.
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
    /// An invariant.
    Invariant,
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
            Self::Invariant => "invariant",
        })
    }
}

/// What a name stands for.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct Symbol {
    /// The kind of thing.
    pub kind: NameKind,
    /// The name.
    pub name: Name,
    /// The list that is the scope of a variable or of a subtask's id: the section for parameters, the
    /// quantifier for a bound variable. `None` for all other kinds.
    pub scope: Option<Span>,
}

/// The role of an occurrence.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Role {
    /// It declares the thing.
    Declaration,
    /// It refers to the thing.
    Use,
}

/// A name at a place in a file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Occurrence {
    /// The name itself; with the question mark for a variable.
    pub span: Span,
    /// What it stands for; the declaration may be missing.
    pub symbol: Symbol,
    /// Its role here.
    pub role: Role,
}
