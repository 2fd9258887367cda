//! Kinds of fault of an invalid plan, by stable words.
//!
//! Sentences may improve, so a test names the kind of fault. Invariant: a word is never renamed. The compiler demands a
//! word here for each new kind of failure of the validator.

use std::fmt;

/// A kind of fault.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Fault {
    /// The text is not a plan: parentheses, words that are not steps.
    Syntax,
    /// A step names no action of the domain.
    UnknownAction,
    /// A step names no object of the problem.
    UnknownObject,
    /// A step has too few or too many arguments.
    Arity,
    /// An argument is not of its parameter's type.
    Type,
    /// A step's precondition does not hold.
    Precondition,
    /// A step takes too long or too short, or does not say how long.
    Duration,
    /// A condition over all of a step is violated.
    Invariant,
    /// Two things happen at once, and their order matters.
    Interference,
    /// Effects of one step contradict each other.
    Conflict,
    /// An effect reads a fluent that has no value, or divides by zero.
    Undefined,
    /// Continuous change, processes or events have no result.
    Change,
    /// The states that the plan goes through break a constraint.
    Constraint,
    /// The goal does not hold in the end.
    Goal,
    /// The decomposition does not begin with the problem's task network.
    Root,
    /// A task's method is one of another task, or not for its arguments.
    Method,
    /// A task's subtasks are not those of its method.
    Subtasks,
    /// The constraints of a task network do not hold.
    MethodConstraint,
    /// A method's precondition does not hold where its task is carried out.
    MethodPrecondition,
    /// Steps are in an order that a task network forbids.
    Ordering,
    /// An action or task of the plan comes out of no task.
    Orphan,
    /// An action or task of the plan is used twice.
    Shared,
    /// A task is a subtask of itself.
    Cycle,
    /// The task network cannot become these steps.
    Decomposition,
    /// Domain and problem have no meaning under which a plan could be valid.
    IllFormed,
}

impl Fault {
    /// Every kind.
    pub const ALL: &'static [Self] = &[
        Self::Syntax,
        Self::UnknownAction,
        Self::UnknownObject,
        Self::Arity,
        Self::Type,
        Self::Precondition,
        Self::Duration,
        Self::Invariant,
        Self::Interference,
        Self::Conflict,
        Self::Undefined,
        Self::Change,
        Self::Constraint,
        Self::Goal,
        Self::Root,
        Self::Method,
        Self::Subtasks,
        Self::MethodConstraint,
        Self::MethodPrecondition,
        Self::Ordering,
        Self::Orphan,
        Self::Shared,
        Self::Cycle,
        Self::Decomposition,
        Self::IllFormed,
    ];

    /// Its word.
    pub const fn word(self) -> &'static str {
        match self {
            Self::Syntax => "syntax",
            Self::UnknownAction => "unknown-action",
            Self::UnknownObject => "unknown-object",
            Self::Arity => "arity",
            Self::Type => "type",
            Self::Precondition => "precondition",
            Self::Duration => "duration",
            Self::Invariant => "invariant",
            Self::Interference => "interference",
            Self::Conflict => "conflict",
            Self::Undefined => "undefined",
            Self::Change => "change",
            Self::Constraint => "constraint",
            Self::Goal => "goal",
            Self::Root => "root",
            Self::Method => "method",
            Self::Subtasks => "subtasks",
            Self::MethodConstraint => "method-constraint",
            Self::MethodPrecondition => "method-precondition",
            Self::Ordering => "ordering",
            Self::Orphan => "orphan",
            Self::Shared => "shared",
            Self::Cycle => "cycle",
            Self::Decomposition => "decomposition",
            Self::IllFormed => "ill-formed",
        }
    }

    /// The kind of that word.
    pub fn of_word(word: &str) -> Option<Self> {
        Self::ALL.iter().copied().find(|fault| fault.word() == word)
    }

    /// What a diagnostic about a plan's text amounts to; `None` for those that have a code only.
    pub(crate) fn of_code(code: &str) -> Option<Self> {
        match code {
            "E0204" => Some(Self::UnknownObject),
            "E0206" => Some(Self::UnknownAction),
            "E0301" => Some(Self::Arity),
            "E0302" => Some(Self::Type),
            code if code.starts_with("E01") => Some(Self::Syntax),
            _ => None,
        }
    }
}

impl fmt::Display for Fault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.word())
    }
}

#[cfg(test)]
mod tests {
    use super::Fault;

    #[test]
    fn words_are_different() {
        for &fault in Fault::ALL {
            assert_eq!(Fault::of_word(fault.word()), Some(fault));
        }
    }
}
