//! What each step changed.

use crate::cause::Cause;
use crate::number::Number;
use crate::value::{GroundAtom, Value};
use crate::verdict::{Breach, File};
use pddl::Span;
use pddl::model::{GroundApplication, Name, ObjectId};

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

/// What one step changed, in the order of its effects.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Diff {
    /// Atoms that did not hold and now do.
    pub added: Vec<GroundAtom>,
    /// Atoms that held and no longer do.
    pub deleted: Vec<GroundAtom>,
    /// Fluents with another value.
    pub fluents: Vec<FluentChange>,
    /// Atoms that follow by axioms now and did not.
    pub derived: Vec<GroundAtom>,
    /// Atoms that followed and no longer do.
    pub no_longer_derived: Vec<GroundAtom>,
    /// Fluents that no event set and that had another value just before than after the last happening.
    pub flowed: Vec<FluentChange>,
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
    /// What holds before the first one: nothing is deleted, and no fluent has a value before.
    pub initial: Diff,
    /// In order of time.
    pub happenings: Vec<Happening>,
    /// The constraints on the whole trajectory; none if the plan failed before its end.
    pub watched: Vec<Watched>,
}

/// A constraint on the trajectory for one binding of the `forall`s around it, and where its conditions hold.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Watched {
    /// Whether the domain or the problem has it.
    pub file: File,
    /// Where it stands.
    pub span: Span,
    /// Whether it must hold.
    pub demand: Demand,
    /// The values of the variables of the `forall`s and `exists`s around its first condition.
    pub binding: Vec<(Name, ObjectId)>,
    /// How and, in seconds or steps, when it is broken; `None` if it is not.
    pub broken: Option<(Breach, Option<Number>)>,
    /// Each condition in it: where it stands, and from when until when it holds.
    pub conditions: Vec<(Span, Vec<Stretch>)>,
}

/// Whether a constraint must hold or should.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Demand {
    /// It must.
    Hard,
    /// It is a preference, perhaps with a name.
    Preference(Option<Name>),
}

/// A time in which something holds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Stretch {
    /// Its begin, in seconds or steps.
    pub from: Number,
    /// Its end; `None` is never.
    pub until: Option<Number>,
}
