//! Liveness: an agent that dies gives up what it holds.
//!
//! Problem: the thread of an agent ends, by a panic or normally, and the loudspeaker stays leased to the agent. Idea:
//! the code that runs the agent keeps a [`Liveness`]. Dropping it, as unwinding its thread does, expires the agent in a
//! commit of its own: its leases pass to the agents that wait for them, and its reflexes fire. For an agent in another
//! process, the server of its connection keeps the `Liveness` and drops it when the connection ends.

use crate::graph::Graph;
use crate::id::AgentId;

/// Keeps an agent alive. Dropping it expires the agent, at the time of the newest commit.
#[derive(Debug)]
#[must_use = "dropping it expires the agent"]
pub struct Liveness {
    graph: Graph,
    agent: AgentId,
}

impl Graph {
    /// Expires the agent when the returned value is dropped.
    pub fn attend(&self, agent: AgentId) -> Liveness {
        Liveness { graph: self.clone(), agent }
    }
}

impl Liveness {
    /// The agent.
    pub fn agent(&self) -> AgentId {
        self.agent
    }
}

impl Drop for Liveness {
    fn drop(&mut self) {
        // Rejected only for an agent of another vocabulary, which holds nothing here.
        let _ = self.graph.expire(self.agent, self.graph.snapshot().time());
    }
}
