//! One rule at work for one binding.

use dsr::{ReflexId, Time};

use crate::skill::{Ended, Outcome};

/// A running rule. Ids are never given out twice.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct InstanceId(pub(super) u64);

#[derive(Debug)]
pub(super) struct Instance {
    pub(super) id: InstanceId,
    /// The reflex that stops it.
    pub(super) guard: ReflexId,
    pub(super) since: Time,
    /// When its duration is over.
    pub(super) deadline: Option<Time>,
    pub(super) phase: Phase,
}

#[derive(Debug)]
pub(super) enum Phase {
    /// Its skill is at work.
    Running,
    /// Its skill is over; the end is to be committed.
    Ending(Ended),
}

impl Phase {
    /// What to try after the graph refused an ending: to end as if aborted, then to end without a word.
    pub(super) fn retreat(&self) -> Self {
        let next = match self {
            Self::Ending(ended) if ended.outcome.name() == Outcome::ABORT => Outcome::NOTHING,
            _ => Outcome::ABORT,
        };
        Self::Ending(Ended::otherwise(next))
    }
}
