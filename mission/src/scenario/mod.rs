//! Scenarios: a simulated patient, a simulated clinician, what happens to them, and what must come out.
//!
//! A scenario is TOML with PDDL inside: conditions over the graph, and steps of the plan. Names are
//! resolved when it is read, each mistake at its own line and column, so that a scenario which runs
//! cannot wait for a token that nobody can write.
//!
//! This is data. Whoever has a simulated room and a clock turns it into a script for the room; the
//! verdict is [`Expectation::judge`].

mod condition;
mod disruption;
mod expect;
mod judge;
mod names;
mod patient;
mod read;

use std::sync::Arc;
use std::time::Duration;

use pddl::Source;

pub use condition::GraphCondition;
pub use disruption::{Act, Device, Disruption, Step, Trigger};
pub use expect::{Expectation, Expected, Naming, ReplanExpectation};
pub use judge::{Outcome, Replan, Violation};
pub use patient::{Answer, By, Patient, Reply, ReplyRule};

/// A scenario, read and resolved against its mission.
#[derive(Clone, Debug)]
pub struct Scenario {
    /// The file's name without extension.
    pub name: String,
    /// One line for people.
    pub title: String,
    /// Who is tested.
    pub patient: Patient,
    /// Who may be called.
    pub clinician: Clinician,
    /// What happens.
    pub disruptions: Vec<Disruption>,
    /// What must come out.
    pub expect: Expectation,
    /// Its text; all its spans refer to it.
    pub source: Arc<Source>,
}

/// The simulated clinician.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Clinician {
    /// How long after a call they come; `None`: never.
    pub comes_after: Option<Duration>,
    /// How long they stay; the call is over then.
    pub stays: Duration,
    /// Whether they bring back a person who is out of view.
    pub fetches: bool,
}
