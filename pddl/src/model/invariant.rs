//! `(:invariant NAME …)`: what every run of a robot must satisfy (requirement `:invariants`).
//!
//! A trajectory constraint of PDDL3 says which plans are good. An invariant is a constraint on what really happens: it is
//! never planned with, and a monitor holds it against the states of the world as they come. It therefore has a name, a
//! sentence for the report, and parameters, whose binding says who or what it was broken for.

use super::{Constraint, Name, VariableId, Variables};
use crate::Span;

/// One invariant: its constraint holds for every binding of the parameters.
#[derive(Clone, Debug)]
pub struct Invariant {
    /// Its name.
    pub name: Name,
    /// Parameters and quantified variables.
    pub variables: Variables,
    /// `:says (…)`: a sentence for people; empty if there is none.
    pub says: Vec<Word>,
    /// `:constraint …`
    pub constraint: Constraint,
    /// The whole section.
    pub span: Span,
    /// Where its name stands.
    pub name_span: Span,
}

/// A word of an invariant's sentence.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Word {
    /// As written.
    Text(String),
    /// A parameter: a report puts the name of the object in its place.
    Variable(VariableId),
}
