//! Scenarios: a simulated patient, a simulated clinician, disruptions, and expectations.
//!
//! A scenario is TOML with PDDL inside: conditions over the graph, and steps of the plan. Its names are resolved when it
//! is read, and each mistake is reported at its line and column, so that a running scenario cannot wait for an unknown
//! token.
//!
//! This module is data. The command line turns a scenario into scripts for the simulated room; [`Expectation::judge`]
//! gives the verdict.

mod condition;
mod disruption;
mod expect;
mod judge;
mod library;
mod names;
mod patient;
mod read;

use std::sync::Arc;
use std::time::Duration;

use pddl::Source;

pub use condition::GraphCondition;
pub use disruption::{Act, Device, Disruption, Fault, Repeats, Step, Token, Trigger};
pub use expect::{Expectation, Expected, Naming, ReplanExpectation};
pub use judge::{Outcome, Replan, Violation};
pub use library::Disturbance;
pub use patient::{Answer, By, Patient, Reply, ReplyRule};

/// A scenario, read and resolved against its mission.
#[derive(Clone, Debug)]
pub struct Scenario {
    /// The file's name without extension.
    pub name: String,
    /// One line for people.
    pub title: String,
    /// The simulated patient.
    pub patient: Patient,
    /// The simulated clinician.
    pub clinician: Clinician,
    /// When the run ends whatever happens; `None` leaves it to the run.
    pub horizon: Option<Duration>,
    /// The disruptions.
    pub disruptions: Vec<Disruption>,
    /// The expectations.
    pub expect: Expectation,
    /// Its text; all its spans refer to it.
    pub source: Arc<Source>,
}

/// The simulated clinician.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Clinician {
    /// How long after a call they come; `None` if they never come.
    pub comes_after: Option<Duration>,
    /// Whether they come to an urgent call only.
    pub only_urgent: bool,
    /// How long they stay; then the call is finished.
    pub stays: Duration,
    /// Whether they bring back a person who is out of view.
    pub fetches: bool,
}
