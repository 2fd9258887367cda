//! A run that goes on after the end of its program.
//!
//! Problem: the program ended at any moment, by a crash, a loss of power or Ctrl-C. Idea: what is sensed is the truth, and
//! everything else is expired. The graph goes on from its last version on disk; every agent and PELEA are declared dead in
//! one commit, so that their reflexes take back what they were doing; then all of them begin again and look around. No plan
//! is kept: PELEA asks for one from what it sees.
//!
//! The monitor of the invariants lives through the recorded versions first, so it judges both parts as one run.

use super::guard::Guard;
use super::room::Happened;
use crate::assemble::Assembly;
use dsr::{AgentId, Edit, Graph, Recording, RecordingError, Transaction, TransactionError, Version};
use safety::Broken;
use std::time::Duration;
use tokio::time::Instant;

/// What was before.
#[derive(Default)]
pub(crate) struct Past {
    /// The time of the run when its program ended.
    pub(super) elapsed: Duration,
    /// The monitor, which has seen the past.
    pub(super) guard: Option<Guard>,
    /// What was broken in the past.
    pub(super) broken: Vec<Broken>,
    /// What happened in the room.
    pub(super) happened: Happened,
}

impl Past {
    /// Lives through a recording up to a version. Returns the past, and the mission on the graph that goes on from there;
    /// nobody is expired yet.
    pub(crate) fn relive(
        recording: &Recording,
        until: Version,
        assembly: Assembly,
    ) -> Result<(Self, Assembly), RecordingError> {
        let (mut guard, mut broken): (Option<(Graph, Guard)>, _) = (None, Vec::new());
        let graph = recording.relive(until, |graph| {
            // After a gap it is another graph, and what was before it cannot be judged together with what follows.
            let (_, guard) = match &mut guard {
                Some((watched, guard)) if watched.is(graph) => (watched, guard),
                other => {
                    let new = Guard::new(&assembly.invariants, graph, Instant::now());
                    let (watched, guard) = other.insert((graph.clone(), new));
                    (watched, guard)
                }
            };
            broken.extend(guard.follow());
        })?;
        let elapsed = Duration::from_nanos(graph.snapshot().time().0);
        let guard = guard.map(|(_, guard)| guard);
        Ok((Self { elapsed, guard, broken, happened: Happened::default() }, assembly.on(graph)))
    }

    /// With what happened in the room.
    pub(crate) fn with(self, happened: Happened) -> Self {
        Self { happened, ..self }
    }

    /// The time of the run when its program ended.
    pub(crate) fn elapsed(&self) -> Duration {
        self.elapsed
    }
}

/// Declares everybody dead, in one commit.
///
/// # Errors
/// Never for the agents of the graph itself.
pub(crate) fn expire_all(graph: &Graph) -> Result<(), TransactionError> {
    let (snapshot, mut transaction) = (graph.snapshot(), Transaction::new(AgentId::DSR));
    for agent in snapshot.vocabulary().agents() {
        transaction.push(Edit::Expire { agent });
    }
    graph.commit(&transaction, snapshot.time()).map(drop)
}
