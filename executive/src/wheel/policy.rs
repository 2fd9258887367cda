//! What the mission's text decides about the wheel: its limits, and what is done when they are reached.

use crate::Step;
use std::time::Duration;

/// The limits of a mission, and the tasks for when it does not go on.
#[derive(Clone, Debug)]
pub struct Policy {
    /// The task to carry out while there is no plan.
    pub fallback: Step,
    /// The task to carry out when the mission does not get on; the fallback if the mission names none.
    pub escalation: Option<Step>,
    /// The task to carry out while a plan is made, if that takes longer than `meanwhile_after`.
    pub meanwhile: Option<Step>,
    /// How long a decision takes before `meanwhile` starts.
    pub meanwhile_after: Duration,
    /// How long a decision takes before the fallback starts. A later plan displaces it.
    pub deciding: Duration,
    /// How many states one search may expand.
    pub expansions: u64,
    /// How often one step may fail without progress before its failure is escalated.
    pub attempts: u32,
    /// What may happen without progress before that is escalated.
    pub bounds: Bounds,
}

/// How often something may happen without progress.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Bounds {
    /// Plans that replace a plan.
    pub replans: u32,
    /// Starts of one and the same step.
    pub restarts: u32,
    /// Requests in a row whose answers the world had overtaken.
    pub asks: u32,
}

impl Policy {
    /// The limits of a mission that sets none.
    pub fn new(fallback: Step) -> Self {
        Self {
            fallback,
            escalation: None,
            meanwhile: None,
            meanwhile_after: Duration::from_secs(1),
            deciding: Duration::from_secs(10),
            expansions: 20_000,
            attempts: 3,
            bounds: Bounds { replans: 20, restarts: 10, asks: 20 },
        }
    }

    pub(super) fn escalation(&self) -> &Step {
        self.escalation.as_ref().unwrap_or(&self.fallback)
    }
}
