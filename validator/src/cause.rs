//! What changes a state, so that a verdict can say who did it.
//!
//! The state notes of each atom the moment of its last change: a small number that is counted up. Which
//! step, start, end or event a moment belongs to is kept here.

use crate::plan::StepIndex;
use crate::relation::Moment;
use pddl::model::EventId;

/// Something that happens at one time.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Cause {
    /// An instantaneous step.
    Step(StepIndex),
    /// The start of a durative step.
    Start(StepIndex),
    /// The end of a durative step.
    End(StepIndex),
    /// The problem's timed change at this position.
    Timed(u32),
    /// An event of the domain.
    Event(EventId),
}

impl Cause {
    /// The step whose doing it is.
    pub fn step(self) -> Option<StepIndex> {
        match self {
            Self::Step(step) | Self::Start(step) | Self::End(step) => Some(step),
            Self::Timed(_) | Self::Event(_) => None,
        }
    }
}

/// Whose doing the moments are.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Causes<'a> {
    /// Moment `n` is the `n`-th step.
    Steps,
    /// Moment `n` is the `n`-th of these.
    Listed(&'a [Cause]),
}

impl Causes<'_> {
    /// Who did it; nobody in the initial state.
    pub(crate) fn of(self, moment: Moment) -> Option<Cause> {
        let index = moment.checked_sub(1)?;
        match self {
            Self::Steps => Some(Cause::Step(StepIndex(index))),
            Self::Listed(causes) => causes.get(index as usize).copied(),
        }
    }

    /// How many moments there were, if there were so many steps.
    pub(crate) fn len(self, steps: u32) -> usize {
        match self {
            Self::Steps => steps as usize,
            Self::Listed(causes) => causes.len(),
        }
    }
}
