//! A turn of the wheel as a record: what it was handed, when, and what it answered.
//!
//! Problem: a decision must be explainable afterwards, exactly as it was made. Idea: the wheel is a pure function of its
//! events and their times. The graph's journal has every version; a record names the version, and so the same turn can
//! be taken again. Decision Support is deterministic, so a record names the request that was answered, not the plan.
//!
//! Invariant: the wheel that starts from the same mission and is handed the same occurrences answers with the same
//! effects, byte for byte in their serialised form.

use crate::Step;
use crate::arrivals::Arrival;
use crate::decision_support::{Decision, RequestId};
use crate::goal::GoalId;
use crate::narration::Narration;
use crate::outcome::{Ending, NoPlan};
use crate::wheel::{Effect, Event};
use dsr::{Edit, Time, Version};
use serde::{Deserialize, Serialize, Serializer};

/// One turn: an occurrence, its time and the effects.
#[derive(Clone, Debug, Serialize)]
pub struct Turn<'a> {
    /// Nanoseconds since the mission started.
    pub now: u64,
    /// What the wheel was handed.
    pub event: Occurrence,
    /// What it answered, in order.
    pub effects: &'a [Effect],
}

impl<'a> Turn<'a> {
    pub(crate) fn new(now: Time, event: Occurrence, effects: &'a [Effect]) -> Self {
        Self { now: now.0, event, effects }
    }
}

/// An event of the wheel without what the journal of the graph already has.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Occurrence {
    /// This version of the graph, with its delta.
    Changed(u64),
    /// This version of the graph, without a delta.
    Seen(u64),
    /// The timer.
    Woke,
    /// The answer to a request.
    Decided(u64),
    /// The planner stopped without an answer to a request: it panicked, or was cancelled.
    Stopped(u64),
    /// A write stands.
    Written,
    /// A write was refused; the reason in words.
    Refused(String),
}

impl From<&Event> for Occurrence {
    fn from(event: &Event) -> Self {
        match event {
            Event::Changed { delta, .. } => Self::Changed(delta.version.0),
            Event::Seen(snapshot) => Self::Seen(snapshot.version().0),
            Event::Woke => Self::Woke,
            Event::Decided(RequestId(id), Decision::NoPlan(NoPlan::Stopped)) => Self::Stopped(*id),
            Event::Decided(RequestId(id), _) => Self::Decided(*id),
            Event::Written => Self::Written,
            Event::Refused(why) => Self::Refused(why.to_string()),
        }
    }
}

impl Occurrence {
    /// The version of the graph that it is about.
    pub fn version(&self) -> Option<Version> {
        match self {
            Self::Changed(version) | Self::Seen(version) => Some(Version(*version)),
            _ => None,
        }
    }
}

/// An effect as data. The state of a request is that of the graph, and is left out.
impl Serialize for Effect {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        #[derive(Serialize)]
        #[serde(rename_all = "snake_case")]
        enum Record<'a> {
            Write(&'a [Edit]),
            Plan {
                request: RequestId,
                goals: &'a [GoalId],
                broken: usize,
                is_running: bool,
                barred: &'a [Step],
                expansions: u64,
                #[serde(skip_serializing_if = "<[_]>::is_empty")]
                objects: &'a [Arrival],
            },
            Cancel(RequestId),
            WakeAt(u64),
            Tell(&'a Narration),
            End(&'a Ending),
        }
        let record = match self {
            Self::Write(edits) => Record::Write(edits),
            Self::Plan(request) => Record::Plan {
                request: request.id,
                goals: &request.goals,
                broken: request.broken.len(),
                is_running: !request.running.is_empty(),
                barred: &request.barred,
                expansions: request.expansions,
                objects: request.arrived.as_ref().map_or(&[], |arrived| &arrived.objects),
            },
            Self::Cancel(request) => Record::Cancel(*request),
            Self::WakeAt(time) => Record::WakeAt(time.0),
            Self::Tell(narration) => Record::Tell(narration),
            Self::End(ending) => Record::End(ending),
        };
        record.serialize(serializer)
    }
}
