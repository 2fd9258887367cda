//! `(:constraints …)`: conditions on the states that a plan goes through.
//!
//! Modal operators may be nested, and connectives may stand between them: competition grammars allow
//! only `and` and `forall` there, and one level, but the meaning of the rest is as clear. Whatever
//! holds no modal operator is one [`ConstraintKind::Holds`], which only stands below an operator.
//!
//! Source: Gerevini & Long, "Plan constraints and preferences in PDDL3", 2005, §3.

use super::{Condition, Preference, VariableId, Variables};
use crate::{Decimal, Span};

/// A constraint with its place.
#[derive(Clone, Debug)]
pub struct Constraint {
    /// What it says.
    pub kind: ConstraintKind,
    /// Where it stands.
    pub span: Span,
}

/// The forms of a constraint. Times are in seconds from the moment at which it is asked: the plan's
/// start, or for a nested one the time of the state that the operator around it looks at.
#[derive(Clone, Debug)]
pub enum ConstraintKind {
    /// In the state that the operator around it looks at.
    Holds(Condition),
    /// All of them; empty is true.
    And(Vec<Constraint>),
    /// One of them; empty is false.
    Or(Vec<Constraint>),
    /// Not so.
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
    /// In no two states with one between them in which it does not hold.
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
    /// What each plan must satisfy; the conjunction at the top is flattened.
    pub hard: Vec<Constraint>,
    /// What a good plan satisfies.
    pub preferences: Vec<Preference<Constraint>>,
}

impl Constraints {
    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.hard.is_empty() && self.preferences.is_empty()
    }
}
