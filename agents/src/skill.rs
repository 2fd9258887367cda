//! Skills: the work of a rule between its start and its end.
//!
//! Problem: rules are text, devices are Rust. Idea: a skill is a named, typed entry point: it gets the names of
//! nodes, calls the hardware abstraction and ends with one of the outcomes that it declares, and with results
//! for the rule's `:results` when the outcome is `end`. It never sees the graph change and never writes: the rule
//! gives an outcome its meaning.
//!
//! Invariant: dropping a [`Work`] stops the device, as [`hal::Operation`] promises.

use std::borrow::Borrow;
use std::collections::BTreeMap;
use std::fmt;
use std::future::Future;
use std::ops::RangeInclusive;
use std::pin::Pin;
use std::sync::Arc;

use dsr::{Isometry3, Snapshot, Version};
use hal::{DeviceError, Devices, Evidence};

use crate::words::{Reporter, Words};

/// How a skill, or the rule around it, ends.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Outcome(Arc<str>);

impl Outcome {
    /// The skill succeeded.
    pub const END: &'static str = "end";
    /// A reflex stopped it: the condition over all no longer held.
    pub const ABORT: &'static str = "abort";
    /// The rule's duration ended first.
    pub const TIMEOUT: &'static str = "timeout";
    /// The device failed.
    pub const FAILURE: &'static str = "failure";
    /// The device rejected this request; it may accept another one.
    pub const REFUSED: &'static str = "refused";
    /// The device claims success, and a sensor noticed nothing.
    pub const UNSENSED: &'static str = "unsensed";
    /// The device claims success, and no sensor can tell.
    pub const CLAIMED: &'static str = "claimed";
    /// The outcomes besides `end` of a skill that says or shows something.
    pub(crate) const OF_OUTPUT: &'static [&'static str] =
        &[Self::CLAIMED, Self::UNSENSED, Self::REFUSED, Self::FAILURE];
    /// The outcomes besides `end` of a skill that can only fail with its device.
    pub(crate) const ONLY_FAILURE: &'static [&'static str] = &[Self::FAILURE];
    /// Nothing is written; never in a rule.
    pub(crate) const NOTHING: &'static str = "";

    /// The outcome of that name.
    pub fn new(name: &str) -> Self {
        Self(name.into())
    }

    /// Its name.
    pub fn name(&self) -> &str {
        &self.0
    }
}

impl Borrow<str> for Outcome {
    fn borrow(&self) -> &str {
        &self.0
    }
}

impl fmt::Display for Outcome {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.0)
    }
}

/// A value that a skill returns for one of the rule's `:results`.
#[derive(Debug, Clone, PartialEq)]
pub enum Datum {
    /// The node of this name.
    Node(Arc<str>),
    /// A pose, in metres.
    Pose(Isometry3<f64>),
}

/// The kind of a [`Datum`].
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum DatumKind {
    /// A node.
    Node,
    /// A pose.
    Pose,
}

impl fmt::Display for DatumKind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Node => "node",
            Self::Pose => "pose",
        })
    }
}

/// How a skill ended.
#[derive(Debug, Clone, PartialEq)]
pub struct Ended {
    /// Which outcome.
    pub outcome: Outcome,
    /// As many as in the signature when the outcome is `end`; otherwise empty.
    pub results: Vec<Datum>,
}

impl Ended {
    /// Succeeded, with these results.
    pub fn well(results: Vec<Datum>) -> Self {
        Self { outcome: Outcome::new(Outcome::END), results }
    }

    /// Ended with another outcome.
    pub fn otherwise(outcome: &str) -> Self {
        Self { outcome: Outcome::new(outcome), results: Vec::new() }
    }

    /// The ending of an output, by what is known of it.
    pub(crate) fn of_output(result: Result<Evidence, DeviceError>) -> Self {
        let outcome = match result {
            Ok(Evidence::Sensed) => Outcome::END,
            Ok(Evidence::Claimed) => Outcome::CLAIMED,
            Err(error) => {
                tracing::debug!(%error, "an output device failed");
                match error {
                    DeviceError::NotSensed { .. } => Outcome::UNSENSED,
                    DeviceError::Refused { .. } => Outcome::REFUSED,
                    DeviceError::Disconnected { .. } | DeviceError::Timeout { .. } => Outcome::FAILURE,
                }
            }
        };
        Self { outcome: Outcome::new(outcome), results: Vec::new() }
    }
    /// Succeeded, or failed with the device.
    pub(crate) fn of<T>(result: Result<T, DeviceError>, results: impl FnOnce(T) -> Vec<Datum>) -> Self {
        match result {
            Ok(value) => Self::well(results(value)),
            Err(error) => {
                tracing::debug!(%error, "a device failed");
                Self::otherwise(Outcome::FAILURE)
            }
        }
    }
}

/// What a skill offers to rules.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Signature {
    /// Its name in `:skill`.
    pub name: &'static str,
    /// The nodes that it takes, by what they stand for; `?` ends the name of one that may be left out.
    pub arguments: &'static [&'static str],
    /// The results that it returns at `end`.
    pub results: &'static [DatumKind],
    /// The outcomes that it can report besides `end`.
    pub outcomes: &'static [&'static str],
}

impl Signature {
    /// How many arguments it takes.
    pub fn arity(&self) -> RangeInclusive<usize> {
        self.arguments.iter().filter(|name| !name.ends_with('?')).count()..=self.arguments.len()
    }
}

/// The arguments of a launch.
#[derive(Debug, Clone)]
pub struct Call {
    /// The names of the argument nodes.
    pub arguments: Vec<Arc<str>>,
    /// The graph right after the rule's effects at start.
    pub snapshot: Snapshot,
    /// Since when what the rule is about stands: the same when it begins again after a restart.
    pub since: Version,
}

impl Call {
    /// An argument; empty where the rule gives none.
    pub fn argument(&self, at: usize) -> &str {
        self.arguments.get(at).map_or("", |name| name)
    }

    /// An identity for the other side of a device, to which the same thing may come twice.
    pub fn id(&self, equipment: &Equipment) -> String {
        format!("{}:{}:{}", equipment.run, self.arguments.join("-"), self.since.0)
    }
}

/// Everything that skills use.
#[derive(Clone)]
pub struct Equipment {
    /// The robot's devices.
    pub devices: Devices,
    /// The sentences to say and show.
    pub words: Arc<dyn Words>,
    /// The documents to deliver.
    pub reporter: Arc<dyn Reporter>,
    /// The name of the run, which stays the same over restarts.
    pub run: Arc<str>,
}

/// A skill at work. Dropping it stops the device at once.
pub type Work = Pin<Box<dyn Future<Output = Ended> + Send>>;

/// A skill.
pub trait Skill: Send + Sync {
    /// Its name, arguments, results and outcomes.
    fn signature(&self) -> Signature;

    /// Prepares the work, which starts when it is first polled.
    fn launch(&self, call: Call, equipment: &Equipment) -> Work;
}

/// The skills that rules may name.
#[derive(Clone, Default)]
pub struct Skills {
    by_name: BTreeMap<&'static str, Arc<dyn Skill>>,
}

impl Skills {
    /// The skill of that name.
    pub fn get(&self, name: &str) -> Option<&Arc<dyn Skill>> {
        self.by_name.get(name)
    }

    /// All signatures, by name.
    pub fn signatures(&self) -> impl Iterator<Item = Signature> + '_ {
        self.by_name.values().map(|skill| skill.signature())
    }

    /// Adds a skill; it replaces another one of the same name.
    #[must_use]
    pub fn with(mut self, skill: impl Skill + 'static) -> Self {
        self.by_name.insert(skill.signature().name, Arc::new(skill));
        self
    }
}

impl fmt::Debug for Skills {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_set().entries(self.by_name.keys()).finish()
    }
}
