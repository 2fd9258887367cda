//! The causes of changes, so that a verdict can name them.
//!
//! The state stores for each atom the moment of its last change, a number that counts up. This module maps a moment
//! to its step, start, end, timed change or event.

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
    /// The step of this cause.
    pub fn step(self) -> Option<StepIndex> {
        match self {
            Self::Step(step) | Self::Start(step) | Self::End(step) => Some(step),
            Self::Timed(_) | Self::Event(_) => None,
        }
    }
}

/// The cause at each moment.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Causes<'a> {
    /// Moment `n` is the `n`-th step.
    Steps,
    /// Moment `n` is the `n`-th cause of this list.
    Listed(&'a [Cause]),
}

impl Causes<'_> {
    /// The cause of a change; `None` for the initial state.
    pub(crate) fn of(self, moment: Moment) -> Option<Cause> {
        let index = moment.checked_sub(1)?;
        match self {
            Self::Steps => Some(Cause::Step(StepIndex(index))),
            Self::Listed(causes) => causes.get(index as usize).copied(),
        }
    }

    /// The number of moments so far, for a plan of this many steps.
    pub(crate) fn len(self, steps: u32) -> usize {
        match self {
            Self::Steps => steps as usize,
            Self::Listed(causes) => causes.len(),
        }
    }
}
