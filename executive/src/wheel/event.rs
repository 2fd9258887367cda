//! The events and the effects of the wheel.

use crate::decision_support::{Decision, Request, RequestId};
use crate::narration::Narration;
use crate::outcome::Ending;
use dsr::{Delta, Edit, Snapshot, Time, TransactionError};
use std::sync::Arc;

/// The events that turn the wheel. Closed: the executive learns of nothing else.
#[derive(Clone, Debug)]
pub enum Event {
    /// The graph has a new version, which differs from the one before in what the wheel reads. Versions that do not may
    /// be left out.
    Changed {
        /// The graph.
        snapshot: Snapshot,
        /// What changed.
        delta: Arc<Delta>,
    },
    /// The present graph without a delta: at the start, or after commits were missed.
    Seen(Snapshot),
    /// The time of [`Effect::WakeAt`] has come, and every version that was committed until now has been handed in.
    Woke,
    /// Decision Support answers.
    Decided(RequestId, Decision),
    /// A write stands in the graph, and the version that it made has been handed in.
    Written,
    /// A write was refused by the graph; nothing of it stands there.
    Refused(TransactionError),
}

/// The effects of a turn, to be carried out in order.
#[derive(Clone, Debug)]
pub enum Effect {
    /// Commit these edits as PELEA, in one transaction, and answer with [`Event::Written`] or
    /// [`Event::Refused`]. At most one of them a turn.
    Write(Vec<Edit>),
    /// Plan, and answer with [`Event::Decided`].
    Plan(Request),
    /// Decision Support need not answer this request any more.
    Cancel(RequestId),
    /// Send [`Event::Woke`] at this time; replaces an earlier one.
    WakeAt(Time),
    /// Report this to the listeners.
    Tell(Narration),
    /// The mission is over; the wheel turns no more.
    End(Ending),
}
