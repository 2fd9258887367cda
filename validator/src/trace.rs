//! The changes of each step.

use crate::cause::Cause;
use crate::number::Number;
use crate::value::{GroundAtom, Value};
use crate::verdict::{Breach, File};
use pddl::Span;
use pddl::model::{GroundApplication, Name, ObjectId};

/// A fluent whose value changed.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct FluentChange {
    /// The fluent.
    pub fluent: GroundApplication,
    /// Its value before; `None` is undefined.
    pub before: Option<Value>,
    /// Its value after.
    pub after: Option<Value>,
}

/// What one step changed, in the order of its effects.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Diff {
    /// Atoms that did not hold and now do.
    pub added: Vec<GroundAtom>,
    /// Atoms that held and no longer do.
    pub deleted: Vec<GroundAtom>,
    /// Fluents with another value.
    pub fluents: Vec<FluentChange>,
    /// Atoms that the axioms derive now and did not before.
    pub derived: Vec<GroundAtom>,
    /// Atoms that the axioms derived before and no longer do.
    pub no_longer_derived: Vec<GroundAtom>,
    /// Fluents that changed continuously since the last happening.
    pub flowed: Vec<FluentChange>,
}

/// The changes at one time: those of one step, or of all simultaneous points of a plan with times.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Happening {
    /// The time in seconds; in a plan without times the number of steps so far.
    pub time: Number,
    /// Its causes.
    pub causes: Vec<Cause>,
    /// The changes.
    pub diff: Diff,
}

/// All happenings up to the end or the failure of the plan.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Trace {
    /// The initial state, as additions: nothing is deleted, and no fluent has a value before.
    pub initial: Diff,
    /// In order of time.
    pub happenings: Vec<Happening>,
    /// The constraints on the whole trajectory; empty if the plan failed before its end.
    pub watched: Vec<Watched>,
}

/// A trajectory constraint under one binding of the `forall`s around it, and the times at which its conditions hold.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Watched {
    /// The file with the constraint: the domain or the problem.
    pub file: File,
    /// Its place.
    pub span: Span,
    /// Whether it is hard or a preference.
    pub demand: Demand,
    /// The values of the variables of the `forall`s and `exists`s around its first condition.
    pub binding: Vec<(Name, ObjectId)>,
    /// The violation with its time in seconds or steps; `None` if the trajectory satisfies it.
    pub broken: Option<(Breach, Option<Number>)>,
    /// Each condition in it: its place, and the intervals in which it holds.
    pub conditions: Vec<(Span, Vec<Stretch>)>,
}

/// Whether a constraint is hard or soft.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Demand {
    /// It must hold.
    Hard,
    /// It is a preference, with its name if it has one.
    Preference(Option<Name>),
}

/// An interval in which a condition holds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Stretch {
    /// Its begin, in seconds or steps.
    pub from: Number,
    /// Its end; `None` is never.
    pub until: Option<Number>,
}
