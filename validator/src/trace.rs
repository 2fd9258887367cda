//! What each step changed.

use crate::state::{GroundAtom, Value};
use pddl::model::GroundApplication;

/// A fluent that got another value.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct FluentChange {
    /// Which one.
    pub fluent: GroundApplication,
    /// What it was; `None` is undefined.
    pub before: Option<Value>,
    /// What it is.
    pub after: Option<Value>,
}

/// What one step changed, in the order of its effects. Derived atoms are not listed.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Diff {
    /// Atoms that did not hold and now do.
    pub added: Vec<GroundAtom>,
    /// Atoms that held and no longer do.
    pub deleted: Vec<GroundAtom>,
    /// Fluents with another value.
    pub fluents: Vec<FluentChange>,
}

/// The changes of every step that could be taken.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Trace {
    /// One per step, up to the one that failed.
    pub steps: Vec<Diff>,
}
