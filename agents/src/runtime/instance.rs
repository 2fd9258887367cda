//! One running rule, for one binding.

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
    /// Its skill has ended; the effects are to be committed.
    Ending(Ended),
}

impl Phase {
    /// The ending to try after the graph refused one: first as if aborted, then without any effect.
    pub(super) fn retreat(&self) -> Self {
        let next = match self {
            Self::Ending(ended) if ended.outcome.name() == Outcome::ABORT => Outcome::NOTHING,
            _ => Outcome::ABORT,
        };
        Self::Ending(Ended::otherwise(next))
    }
}
