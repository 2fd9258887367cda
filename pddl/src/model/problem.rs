//! Problems.

use super::{
    Condition, Expression, FunctionId, IndexVec, Name, Object, ObjectId, PredicateId, Requirements,
    TaskNetwork, Variables,
};
use crate::Span;

/// A ground atom that holds initially.
#[derive(Clone, Debug)]
pub struct Fact {
    /// Which predicate.
    pub predicate: PredicateId,
    /// Its arguments.
    pub arguments: Vec<ObjectId>,
    /// Where it stands.
    pub span: Span,
}

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
    /// Which way.
    pub objective: Objective,
    /// What is measured.
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
    /// What holds initially; the rest is false.
    pub init: Vec<Fact>,
    /// Initial values; the rest is undefined.
    pub fluents: Vec<FluentFact>,
    /// Quantified variables of the goal (no parameters).
    pub goal_variables: Variables,
    /// What shall hold in the end; `always` for an HTN problem without a goal.
    pub goal: Condition,
    /// What to optimise.
    pub metric: Option<Metric>,
    /// The initial task network of an HTN problem, with its parameters.
    pub htn: Option<(Variables, TaskNetwork)>,
    /// Language features that the model does not hold, with their places.
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
