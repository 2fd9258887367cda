//! Ground atoms, the facts of a state, and what grounding found out about each atom.

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

/// An object fluent has a value.
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
    /// The atom; `None` for the value of a fluent and for what grounding made up for a disjunction.
    pub atom: Option<GroundAtom>,
    /// The object fluent whose value it tells, if it does.
    pub value: Option<ObjectValue>,
    /// Whether axioms or numbers decide it.
    pub derived: bool,
    /// Whether it compares numbers.
    pub compares: bool,
}

/// What grounding found out about a ground atom.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum AtomStatus {
    /// It changes, and states hold it.
    Fact(FactId),
    /// It holds in every reachable state.
    AlwaysTrue,
    /// It holds in no reachable state.
    NeverTrue,
    /// It may change, but neither the goal nor any useful action asks for it.
    Irrelevant,
}
