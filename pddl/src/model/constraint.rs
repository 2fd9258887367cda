//! `(:constraints …)`: conditions on the states that a plan goes through.
//!
//! Modal operators may be nested, and connectives may stand between them. Competition grammars allow only
//! `and` and `forall` there, and one level, but the semantics of the rest is as clear. A part without a
//! modal operator is one [`ConstraintKind::Holds`], which only stands below an operator.
//!
//! Source: Gerevini & Long, "Plan constraints and preferences in PDDL3", 2005, §3.

use super::{Condition, Preference, VariableId, Variables};
use crate::{Decimal, Span};

/// A constraint with its place.
#[derive(Clone, Debug)]
pub struct Constraint {
    /// Its form.
    pub kind: ConstraintKind,
    /// Where it stands.
    pub span: Span,
}

/// The forms of a constraint. Times are in seconds from the moment of evaluation: the plan's start, or for a
/// nested constraint the time of the state that the enclosing operator refers to.
#[derive(Clone, Debug)]
pub enum ConstraintKind {
    /// In the state that the enclosing operator refers to.
    Holds(Condition),
    /// All of them; empty is true.
    And(Vec<Constraint>),
    /// One of them; empty is false.
    Or(Vec<Constraint>),
    /// Negation.
    Not(Box<Constraint>),
    /// If the first, then the second.
    Imply(Box<Constraint>, Box<Constraint>),
    /// For some binding of these slots.
    Exists(Vec<VariableId>, Box<Constraint>),
    /// For every binding of these slots.
    Forall(Vec<VariableId>, Box<Constraint>),
    /// In the last state.
    AtEnd(Box<Constraint>),
    /// In every state.
    Always(Box<Constraint>),
    /// In some state.
    Sometime(Box<Constraint>),
    /// In some state not later than this.
    Within(Decimal, Box<Constraint>),
    /// At most once: no two states with it have a state without it between them.
    AtMostOnce(Box<Constraint>),
    /// After each state with the first, or in it, there is one with the second.
    SometimeAfter(Box<Constraint>, Box<Constraint>),
    /// Before each state with the first there is one with the second.
    SometimeBefore(Box<Constraint>, Box<Constraint>),
    /// After each state with the first there is, not later than this, one with the second.
    AlwaysWithin(Decimal, Box<Constraint>, Box<Constraint>),
    /// From the first time until before the second.
    HoldDuring(Decimal, Decimal, Box<Constraint>),
    /// From this time on.
    HoldAfter(Decimal, Box<Constraint>),
}

/// All constraints of a domain or a problem.
#[derive(Clone, Debug, Default)]
pub struct Constraints {
    /// Quantified variables (no parameters).
    pub variables: Variables,
    /// Constraints that each plan must satisfy; the conjunction at the top is flattened.
    pub hard: Vec<Constraint>,
    /// Constraints that a good plan satisfies.
    pub preferences: Vec<Preference<Constraint>>,
}

impl Constraints {
    /// Whether it is empty.
    pub fn is_empty(&self) -> bool {
        self.hard.is_empty() && self.preferences.is_empty()
    }
}
