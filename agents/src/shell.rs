//! The shell: drives agents over the real graph, clock and devices.
//!
//! Idea: one future per agent that is woken by the graph (for the agent's interest alone), by a skill, or by the time.
//! It feeds the pure [`Runtime`] and does what that asks for. `supervisor` begins and ends the lives of agents, and `work`
//! keeps skills apart: together in the caller's task, or each agent and each skill on a thread of its own
//! ([`Housing`]).
//!
//! Invariants: where all work together, the same wakings in the same order give the same commits. News of the graph come
//! before endings of skills, so that a skill which a reflex stopped can no longer end; skills are polled in the order of
//! their launch. Dropping the future drops every skill, which stops every device, and expires every agent.

mod attentive;
mod drive;
mod pulse;
mod supervisor;
mod work;

use std::fmt;
use std::sync::Arc;

use dsr::{Graph, Time};
use tokio::time::Instant;

pub use self::pulse::Absence;
pub use self::supervisor::run_all;
pub use self::work::Housing;
use crate::skill::Equipment;

/// The clock that commits are stamped with.
pub trait Clock: Send + Sync {
    /// Now; never less than before.
    fn now(&self) -> Time;
}

/// Tokio's clock, from an instant on; simulated where that is paused.
#[derive(Debug, Clone, Copy)]
pub struct TokioClock {
    started: Instant,
}

impl TokioClock {
    /// Time 0 is now.
    pub fn start() -> Self {
        Self::since(Instant::now())
    }

    /// Time 0 is this instant.
    pub fn since(started: Instant) -> Self {
        Self { started }
    }
}

impl Clock for TokioClock {
    fn now(&self) -> Time {
        Time(u64::try_from(self.started.elapsed().as_nanos()).unwrap_or(u64::MAX))
    }
}

/// Where agents live.
#[derive(Clone)]
pub struct Environment {
    /// The shared graph.
    pub graph: Graph,
    /// What skills work with.
    pub equipment: Equipment,
    /// The time.
    pub clock: Arc<dyn Clock>,
    /// Where agents and skills work.
    pub housing: Housing,
    /// How the graph says that an agent is absent, if the vocabulary has words for it.
    pub absence: Option<Absence>,
}

impl fmt::Debug for Environment {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Environment").field("graph", &self.graph).finish_non_exhaustive()
    }
}
