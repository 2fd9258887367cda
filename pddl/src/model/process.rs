//! PDDL+: processes and events, and continuous change.
//!
//! Source: Fox & Long, "Modelling mixed discrete-continuous domains for planning", JAIR 2006.

use super::{Application, Condition, Effect, Expression, Name, VariableId, Variables};
use crate::Span;

/// An object fluent as an argument, where nothing can bind its value: the slot stands for it.
#[derive(Clone, Debug)]
pub struct FunctionTerm {
    /// The slot.
    pub slot: VariableId,
    /// What has the value. Its own arguments may be slots of functions before it.
    pub application: Application,
}

/// Which way a fluent changes with time.
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
    /// Which way.
    pub direction: Direction,
    /// What changes.
    pub fluent: Application,
    /// By how much in a second; it may itself change with time.
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
    /// When it runs.
    pub precondition: Condition,
    /// What it changes meanwhile.
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
    /// When it happens.
    pub precondition: Condition,
    /// What it does.
    pub effect: Effect,
    /// The whole definition.
    pub span: Span,
    /// The name in the definition.
    pub name_span: Span,
}
