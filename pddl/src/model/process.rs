//! PDDL+: processes and events, and continuous change.
//!
//! Source: Fox & Long, "Modelling mixed discrete-continuous domains for planning", JAIR 2006.

use super::{Application, Condition, Effect, Expression, Name, VariableId, Variables};
use crate::Span;

/// An object fluent as an argument in a place without a quantifier: the slot stands for its value.
#[derive(Clone, Debug)]
pub struct FunctionTerm {
    /// The slot.
    pub slot: VariableId,
    /// The fluent. Its own arguments may be slots of earlier functions.
    pub application: Application,
}

/// The direction in which a fluent changes with time.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Direction {
    /// `increase`
    Increase,
    /// `decrease`
    Decrease,
}

/// `(forall (?x …) (increase (f ?x) (* #t rate)))`
#[derive(Clone, Debug)]
pub struct ContinuousEffect {
    /// The slots of all `forall`s around it, outermost first.
    pub forall: Vec<VariableId>,
    /// Functions that stand as arguments, innermost first.
    pub functions: Vec<FunctionTerm>,
    /// The direction.
    pub direction: Direction,
    /// The fluent that changes.
    pub fluent: Application,
    /// The rate per second; it may itself change with time.
    pub rate: Expression,
    /// Where it stands.
    pub span: Span,
}

/// `(:process …)`: runs as long as its condition holds.
#[derive(Clone, Debug)]
pub struct Process {
    /// Its name.
    pub name: Name,
    /// Parameters and quantified variables.
    pub variables: Variables,
    /// The condition under which it runs.
    pub precondition: Condition,
    /// The continuous effects while it runs.
    pub effects: Vec<ContinuousEffect>,
    /// The whole definition.
    pub span: Span,
    /// The name in the definition.
    pub name_span: Span,
}

/// `(:event …)`: happens at once when its condition holds.
#[derive(Clone, Debug)]
pub struct Event {
    /// Its name.
    pub name: Name,
    /// Parameters and quantified variables.
    pub variables: Variables,
    /// The condition that triggers it.
    pub precondition: Condition,
    /// Its effect.
    pub effect: Effect,
    /// The whole definition.
    pub span: Span,
    /// The name in the definition.
    pub name_span: Span,
}
