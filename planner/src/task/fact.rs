//! Ground atoms, the facts of a state, and the status of each atom.

use crate::ids::FactId;
use pddl::model::{GroundApplication, ObjectId, PredicateId};

/// A ground atom.
#[derive(Clone, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct GroundAtom {
    /// Its predicate.
    pub predicate: PredicateId,
    /// Its arguments.
    pub arguments: Box<[ObjectId]>,
}

/// An object fluent with a value.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct ObjectValue {
    /// The fluent.
    pub fluent: GroundApplication,
    /// Its value.
    pub object: ObjectId,
}

/// A bit of a state.
#[derive(Clone, Debug)]
pub struct Fact {
    /// The atom; `None` for the value of a fluent and for an auxiliary fact of grounding.
    pub atom: Option<GroundAtom>,
    /// The object fluent and the value that the fact represents, if any.
    pub value: Option<ObjectValue>,
    /// Whether axioms or numbers define it.
    pub derived: bool,
    /// Whether it is a comparison of numbers.
    pub compares: bool,
}

/// The status of a ground atom after grounding.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum AtomStatus {
    /// It changes, and states hold it.
    Fact(FactId),
    /// It holds in every reachable state.
    AlwaysTrue,
    /// It holds in no reachable state.
    NeverTrue,
    /// It may change, but neither the goal nor any useful action reads it.
    Irrelevant,
}
