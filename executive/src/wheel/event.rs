//! What goes into the wheel, and what comes out.

use crate::decision_support::{Decision, Request, RequestId};
use crate::narration::Narration;
use dsr::{Delta, Edit, Snapshot, Time, Version};
use std::sync::Arc;

/// What the wheel turns on. Closed: the executive learns of nothing else.
#[derive(Clone, Debug)]
pub enum Event {
    /// The graph has a new version.
    Changed {
        /// The graph.
        snapshot: Snapshot,
        /// What changed.
        delta: Arc<Delta>,
    },
    /// The graph as it stands, without a history: at the start, or after changes were missed.
    Seen(Snapshot),
    /// The time that [`Effect::WakeAt`] asked for has come.
    Woke,
    /// Decision Support answers.
    Decided(RequestId, Decision),
    /// A write stands in the graph from this version on.
    Written(Version),
    /// A write was refused by the graph; nothing of it stands there.
    Refused(String),
}

/// What the wheel wants done, in order.
#[derive(Clone, Debug)]
pub enum Effect {
    /// Commit these edits as PELEA, in one transaction, and answer with [`Event::Written`] or
    /// [`Event::Refused`]. At most one of them a turn.
    Write(Vec<Edit>),
    /// Plan, and answer with [`Event::Decided`].
    Plan(Request),
    /// Send [`Event::Woke`] then; replaces an earlier wish.
    WakeAt(Time),
    /// Tell whoever listens.
    Tell(Narration),
    /// The mission is over; the wheel turns no more.
    End(Ending),
}

/// How a mission ended.
#[derive(Clone, Debug, PartialEq, Eq, serde::Serialize)]
#[serde(tag = "ending", rename_all = "snake_case")]
pub enum Ending {
    /// The goal was seen to hold.
    Accomplished,
    /// It was not reached; the fallback was carried out or at least tried.
    NotAccomplished {
        /// Why there was no plan any more.
        why: String,
        /// Whether the fallback went through.
        fallback: bool,
    },
}
