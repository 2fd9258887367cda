//! Problems.

use super::{
    Condition, Constraints, Expression, Fact, FunctionId, IndexVec, Name, Object, ObjectId, Preference,
    Requirements, TaskNetwork, Variables,
};
use crate::{Decimal, Span};

/// A ground function application.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct GroundApplication {
    /// Which function.
    pub function: FunctionId,
    /// Its arguments.
    pub arguments: Vec<ObjectId>,
}

/// An initial value of a fluent.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum FluentValue {
    /// A number.
    Number(f64),
    /// An object.
    Object(ObjectId),
}

/// `(= (f a) v)` in the initial state.
#[derive(Clone, Debug)]
pub struct FluentFact {
    /// Which fluent.
    pub application: GroundApplication,
    /// Its value.
    pub value: FluentValue,
    /// Where it stands.
    pub span: Span,
}

/// `(at 5 (p a))` in `:init`: a change that happens whatever the plan does.
#[derive(Clone, Debug)]
pub struct TimedInitial {
    /// The time in seconds from the start; not negative.
    pub time: Decimal,
    /// The change.
    pub change: TimedChange,
    /// The whole `(at 5 …)`; several changes may stand in one.
    pub span: Span,
}

/// A change at a time.
#[derive(Clone, Debug)]
pub enum TimedChange {
    /// A fact becomes true.
    Add(Fact),
    /// A fact becomes false.
    Delete(Fact),
    /// A fluent gets a value.
    Assign(FluentFact),
    /// A fluent loses its value: `(at 5 (= (f a) undefined))`.
    Undefine(GroundApplication),
}

/// Minimise or maximise.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Objective {
    /// `minimize`
    Minimize,
    /// `maximize`
    Maximize,
}

/// `(:metric minimize e)`.
#[derive(Clone, Debug)]
pub struct Metric {
    /// The direction.
    pub objective: Objective,
    /// The expression to optimise.
    pub expression: Expression,
}

/// A problem of one domain.
#[derive(Clone, Debug)]
pub struct Problem {
    /// Its name.
    pub name: Name,
    /// Its own flags (the domain's hold as well).
    pub requirements: Requirements,
    /// The domain's constants, under the same ids, then the problem's objects.
    pub objects: IndexVec<ObjectId, Object>,
    /// The initial facts; all others are false.
    pub init: Vec<Fact>,
    /// Initial values; all others are undefined.
    pub fluents: Vec<FluentFact>,
    /// The timed initial literals and fluents, in the order of the source.
    pub timed: Vec<TimedInitial>,
    /// Quantified variables of the goal and its preferences (no parameters).
    pub goal_variables: Variables,
    /// The goal; a condition that always holds for an HTN problem without a goal.
    pub goal: Condition,
    /// The goal's preferences.
    pub preferences: Vec<Preference<Condition>>,
    /// Constraints on every plan, in addition to the domain's.
    pub constraints: Constraints,
    /// What to optimise.
    pub metric: Option<Metric>,
    /// The initial task network of an HTN problem, with its parameters.
    pub htn: Option<(Variables, TaskNetwork)>,
    /// Language features that are read but not modelled, with their places.
    pub unsupported: Vec<crate::Diagnostic>,
    /// The goal's place.
    pub goal_span: Span,
}

impl Problem {
    /// The object or constant of that name.
    pub fn object(&self, name: &str) -> Option<ObjectId> {
        self.objects.enumerate().find(|(_, o)| &*o.name == name).map(|(id, _)| id)
    }
}
