//! The graph: one handle for everybody, one lock for writers, none that a reader would feel.
//!
//! Idea: a commit computes the next state beside the present one, under the commit lock, and publishes it by
//! exchanging one pointer. Readers take that pointer. Invariants: versions are handed out without gaps; subscribers
//! get commits in order; a transaction that changes nothing makes no version and wakes nobody.

use std::num::NonZeroUsize;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError, RwLock, Weak};

use crate::delta::Delta;
use crate::dictionary::Dictionary;
use crate::export::{self, Export, RestoreError};
use crate::id::{AgentId, ReflexId, Time, Version};
use crate::mentions::Mentions;
use crate::pattern::Pattern;
use crate::replay::{self, ReplayError};
use crate::snapshot::Snapshot;
use crate::state::State;
use crate::subscription::{CAPACITY, Committed, Deltas, Matches, Queue};
use crate::transaction::apply::transact;
use crate::transaction::{Edit, Transaction, TransactionError};

/// What a successful commit made.
#[derive(Debug, Clone)]
pub struct Commit {
    /// The version in which the transaction's content holds: a new one, or the present one if nothing changed.
    pub version: Version,
    /// What changed, the writings of reflexes included.
    pub delta: Arc<Delta>,
    /// The state right after.
    pub snapshot: Snapshot,
    /// The reflexes registered by the transaction, in its order.
    pub guards: Vec<ReflexId>,
}

/// A handle on the shared graph. Clones are the same graph.
#[derive(Clone)]
pub struct Graph {
    shared: Arc<Shared>,
}

struct Shared {
    /// Held while a transaction is applied and its commit handed to the queues.
    commit: Mutex<Vec<Weak<Queue>>>,
    /// Held just long enough to copy or to exchange the pointer.
    current: RwLock<Arc<State>>,
}

impl Drop for Shared {
    fn drop(&mut self) {
        let queues = self.commit.get_mut().unwrap_or_else(PoisonError::into_inner);
        for waker in queues.iter().filter_map(Weak::upgrade).filter_map(|queue| queue.close()) {
            waker();
        }
    }
}

impl Graph {
    /// A graph with the nodes that stand for the dictionary's agents and resources, at version 0.
    pub fn new(dictionary: Arc<Dictionary>) -> Self {
        Self::with(State::new(dictionary))
    }

    /// The graph of an export.
    pub fn restore(dictionary: Arc<Dictionary>, export: &Export) -> Result<Self, RestoreError> {
        Ok(Self::with(export::restore(dictionary, export)?))
    }

    /// The graph of an export and the deltas published after it.
    pub fn replay<'d>(
        dictionary: Arc<Dictionary>,
        initial: &Export,
        deltas: impl IntoIterator<Item = &'d Delta>,
    ) -> Result<Self, ReplayError> {
        let mut state = export::restore(dictionary, initial)?;
        for delta in deltas {
            replay::apply(&mut state, delta)?;
        }
        Ok(Self::with(state))
    }

    fn with(state: State) -> Self {
        let shared = Shared { commit: Mutex::default(), current: RwLock::new(Arc::new(state)) };
        Self { shared: Arc::new(shared) }
    }

    /// The dictionary.
    pub fn dictionary(&self) -> Arc<Dictionary> {
        Arc::clone(&self.current().dictionary)
    }

    /// The present state.
    pub fn snapshot(&self) -> Snapshot {
        Snapshot::new(self.current())
    }

    /// Applies a transaction, as a whole or not at all.
    pub fn commit(&self, transaction: &Transaction, time: Time) -> Result<Commit, TransactionError> {
        let mut wakers = Vec::new();
        let commit = {
            let mut queues = self.lock();
            let outcome = transact(&self.current(), transaction, time)?;
            let state = Arc::new(outcome.state);
            let published = !(outcome.delta.changes.is_empty() && outcome.delta.reflexes.is_empty());
            let snapshot = Snapshot::new(Arc::clone(&state));
            // The state before is dropped after the lock, not under it: freeing it may take a while.
            let _before = self.publish(state);
            let delta = Arc::new(outcome.delta);
            if published {
                let committed = Committed { delta: Arc::clone(&delta), snapshot: snapshot.clone() };
                let touched = Mentions::of(&delta);
                queues.retain(|queue| {
                    let Some(queue) = queue.upgrade() else { return false };
                    wakers.extend(queue.push(&committed, &touched));
                    true
                });
            }
            Commit { version: delta.version, delta, snapshot, guards: outcome.guards }
        };
        for waker in wakers {
            waker();
        }
        Ok(commit)
    }

    /// Writes and commits a transaction.
    pub fn edit(
        &self,
        writer: AgentId,
        time: Time,
        write: impl FnOnce(&mut Transaction),
    ) -> Result<Commit, TransactionError> {
        let mut transaction = Transaction::new(writer);
        write(&mut transaction);
        self.commit(&transaction, time)
    }

    /// Reads a snapshot, writes a transaction from what was read, and commits it on that very version: when
    /// somebody else was faster, `write` is asked again with the newer snapshot. Each retry means that another
    /// commit went through, so the graph as a whole never stands still.
    pub fn update(
        &self,
        writer: AgentId,
        time: Time,
        mut write: impl FnMut(&Snapshot, &mut Transaction),
    ) -> Result<Commit, TransactionError> {
        loop {
            let snapshot = self.snapshot();
            let mut transaction = Transaction::new(writer);
            write(&snapshot, &mut transaction);
            transaction.expect_version(snapshot.version());
            match self.commit(&transaction, time) {
                Err(TransactionError::Stale { .. }) => {}
                other => return other,
            }
        }
    }

    /// Buries an agent: drops its leases and fires its reflexes.
    pub fn expire(&self, agent: AgentId, time: Time) -> Result<Commit, TransactionError> {
        self.edit(AgentId::DSR, time, |transaction| {
            transaction.push(Edit::Expire { agent });
        })
    }

    /// Tells how the matches of a pattern change, beginning with those of now.
    pub fn subscribe(&self, pattern: impl Into<Arc<Pattern>>) -> Matches {
        self.subscribe_with(pattern, CAPACITY)
    }

    /// The same, with a queue of this capacity.
    pub fn subscribe_with(&self, pattern: impl Into<Arc<Pattern>>, capacity: NonZeroUsize) -> Matches {
        let pattern = pattern.into();
        let queue = Queue::new(capacity, Some(pattern.mentions().clone()));
        let start = self.register(&queue);
        Matches::new(queue, pattern, start)
    }

    /// Tells every commit from now on.
    pub fn subscribe_deltas(&self) -> Deltas {
        self.subscribe_deltas_with(CAPACITY)
    }

    /// The same, with a queue of this capacity.
    pub fn subscribe_deltas_with(&self, capacity: NonZeroUsize) -> Deltas {
        let queue = Queue::new(capacity, None);
        let start = self.register(&queue);
        Deltas { queue, start }
    }

    /// Under the commit lock, so that no commit falls between the snapshot and the first event.
    fn register(&self, queue: &Arc<Queue>) -> Snapshot {
        let mut queues = self.lock();
        queues.push(Arc::downgrade(queue));
        self.snapshot()
    }

    fn current(&self) -> Arc<State> {
        Arc::clone(&self.shared.current.read().unwrap_or_else(PoisonError::into_inner))
    }

    fn publish(&self, state: Arc<State>) -> Arc<State> {
        std::mem::replace(&mut self.shared.current.write().unwrap_or_else(PoisonError::into_inner), state)
    }

    /// A panic under the lock is a bug, but not a reason to stop the robot: what is published is always whole.
    fn lock(&self) -> MutexGuard<'_, Vec<Weak<Queue>>> {
        self.shared.commit.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl std::fmt::Debug for Graph {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Graph").field("version", &self.current().version).finish_non_exhaustive()
    }
}
