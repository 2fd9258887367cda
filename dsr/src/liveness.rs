//! An agent that dies gives up what it holds.
//!
//! Problem: the thread of an agent ends, by a panic or because nobody needs it, and the loudspeaker stays leased to it.
//! Idea: whoever runs the agent keeps an [`Liveness`]; when that is dropped, as it is when its thread unwinds, the
//! agent is buried in a commit of its own: its leases go to who waits for them, its reflexes fire. An agent in another
//! process needs somebody here who keeps it, and drops it when the connection ends.

use crate::graph::Graph;
use crate::id::AgentId;

/// An agent's life. Dropping it buries the agent, at the time of the newest commit.
#[derive(Debug)]
#[must_use = "dropped at once, it buries the agent"]
pub struct Liveness {
    graph: Graph,
    agent: AgentId,
}

impl Graph {
    /// The agent lives as long as what this gives.
    pub fn attend(&self, agent: AgentId) -> Liveness {
        Liveness { graph: self.clone(), agent }
    }
}

impl Liveness {
    /// Whose.
    pub fn agent(&self) -> AgentId {
        self.agent
    }
}

impl Drop for Liveness {
    fn drop(&mut self) {
        // Refused only for an agent of another vocabulary, which holds nothing here.
        let _ = self.graph.expire(self.agent, self.graph.snapshot().time());
    }
}
