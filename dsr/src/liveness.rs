//! Liveness: an agent that dies gives up what it holds, and no longer writes.
//!
//! Problem: the thread of an agent ends, by a panic or normally, and the loudspeaker stays leased to the agent. Or it
//! hangs, is replaced, and then goes on: two of the same name write. Idea: the code that runs the agent keeps a
//! [`Liveness`]. Dropping it, as unwinding its thread does, expires the agent in a commit of its own: its leases pass to
//! the agents that wait for them, and its reflexes fire. For an agent in another process, the server of its connection
//! keeps the `Liveness` and drops it when the connection ends.
//!
//! Each life of an agent has a number, its [`Epoch`]. A transaction that names one
//! ([`Transaction::in_epoch`](crate::Transaction::in_epoch)) is refused after that life, so a watchdog may declare an agent
//! dead that only hangs. Invariants: the epochs of an agent rise; dropping the `Liveness` of an earlier life changes
//! nothing.
//!
//! Source: fencing tokens; Kleppmann, *Designing Data-Intensive Applications*, 2017, ch. 8.

use crate::graph::Graph;
use crate::id::{AgentId, Epoch};
use crate::transaction::{Edit, Transaction, TransactionError};

/// Keeps an agent alive. Dropping it expires the agent, at the time of the newest commit.
#[derive(Debug)]
#[must_use = "dropping it expires the agent"]
pub struct Liveness {
    graph: Graph,
    agent: AgentId,
    epoch: Epoch,
    last: Vec<Edit>,
}

impl Graph {
    /// Begins a life of the agent, which expires when the returned value is dropped. Writes for an earlier life are
    /// refused from now on.
    pub fn attend(&self, agent: AgentId) -> Liveness {
        Liveness { graph: self.clone(), agent, epoch: self.begin_life(agent), last: Vec::new() }
    }
}

impl Liveness {
    /// The agent.
    pub fn agent(&self) -> AgentId {
        self.agent
    }

    /// This life of the agent.
    pub fn epoch(&self) -> Epoch {
        self.epoch
    }

    /// What the graph itself writes in the commit in which the agent expires: that it is gone.
    pub fn leave_behind(&mut self, edits: impl IntoIterator<Item = Edit>) {
        self.last.extend(edits);
    }
}

impl Drop for Liveness {
    fn drop(&mut self) {
        let mut end = Transaction::new(AgentId::DSR);
        end.in_epoch(self.agent, self.epoch).push(Edit::Expire { agent: self.agent });
        let without = end.clone();
        end.extend(std::mem::take(&mut self.last));
        let now = self.graph.snapshot().time();
        // Refused if this life is over, and for an agent of another vocabulary, which holds nothing here.
        match self.graph.commit(&end, now) {
            Ok(_) | Err(TransactionError::Fenced { .. }) => {}
            // What was to be left behind is no token of this graph.
            Err(_) => _ = self.graph.commit(&without, now),
        }
    }
}
