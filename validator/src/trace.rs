//! What each step changed. Continuous change is seen in the next step's values only.

use crate::cause::Cause;
use crate::number::Number;
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

/// What happened at one time: a step, or what a plan with times does at once.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Happening {
    /// When, in seconds; in a plan without times how many steps lie behind.
    pub time: Number,
    /// What happened.
    pub causes: Vec<Cause>,
    /// What it changed.
    pub diff: Diff,
}

/// Everything that happened before the plan ended or failed.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Trace {
    /// In order of time.
    pub happenings: Vec<Happening>,
}
