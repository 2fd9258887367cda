//! One running rule, for one binding.

use dsr::{ReflexId, Time};

use crate::rules::{Parameters, RuleId};
use crate::skill::{Ended, Outcome};

/// A rule for a binding of its parameters.
pub(super) type Key = (RuleId, Parameters);

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
    /// Whether the effects of an ending could not be written.
    pub(super) refused: bool,
}

impl Instance {
    pub(super) fn begin(id: InstanceId, guard: ReflexId, since: Time, deadline: Option<Time>) -> Self {
        Self { id, guard, since, deadline, phase: Phase::Running, refused: false }
    }

    /// The effects of its ending cannot be written: the next try is as if aborted, and the last one without any effect.
    pub(super) fn retreat(&mut self) {
        self.refused = true;
        let next = match &self.phase {
            Phase::Ending(ended) if ended.outcome.name() == Outcome::ABORT => Outcome::NOTHING,
            _ => Outcome::ABORT,
        };
        self.phase = Phase::Ending(Ended::otherwise(next));
    }
}

#[derive(Debug)]
pub(super) enum Phase {
    /// Its skill is at work.
    Running,
    /// Its skill has ended; the effects are to be committed.
    Ending(Ended),
}
