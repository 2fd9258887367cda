//! The graph: one handle for everybody, one lock for writers, none that a reader of a snapshot would feel.
//!
//! Problem: a state that is edited in place cannot be read meanwhile, and one that is copied for every commit costs
//! more than the commit. Idea: the state is copied when, and as far as, somebody holds it. A snapshot is a reference
//! to the state; a commit that finds itself the only holder edits in place, any other copies the blocks it touches.
//! Taking a snapshot is an atomic load where one of the present version has been taken before. Where none has, the
//! reader takes it from the state, under the commit lock. A reader that finds the lock held says so, and for the
//! next commits there is always a published one: readers that come again and again do not wait for writers, and
//! writers that nobody watches do not copy. A transaction too long to wait for publishes before it begins.
//!
//! Invariants: what is published is the present version, or the one before the commit in progress; versions are
//! handed out without gaps; subscribers get commits in order; a transaction that changes nothing makes no version
//! and wakes nobody.

use std::num::NonZeroUsize;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use arc_swap::ArcSwapOption;

use crate::delta::Delta;
use crate::dictionary::Dictionary;
use crate::export::{self, Export, RestoreError};
use crate::id::{AgentId, ReflexId, Time, Version};
use crate::pattern::Pattern;
use crate::replay::{self, ReplayError};
use crate::routes::Routes;
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
    dictionary: Arc<Dictionary>,
    /// Held while a transaction is applied and its commit handed to the queues.
    commit: Mutex<Writer>,
    /// A snapshot for whoever asks.
    published: ArcSwapOption<State>,
    /// A reader took what is published since the last commit.
    taken: AtomicBool,
    /// A reader had to wait for a commit.
    waited: AtomicBool,
}

/// What the commit lock guards.
struct Writer {
    state: Arc<State>,
    queues: Routes,
    /// For how many more commits there is always a published state.
    publishing: u32,
}

/// For how many commits that no reader takes note of a state is published all the same.
const PUBLISHED: u32 = 64;

/// A transaction of more edits than this does not keep a reader waiting.
const LONG: usize = 64;

impl Drop for Shared {
    fn drop(&mut self) {
        let writer = self.commit.get_mut().unwrap_or_else(PoisonError::into_inner);
        for waker in writer.queues.queues().filter_map(|queue| queue.close()) {
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
        let dictionary = Arc::clone(&state.dictionary);
        let writer = Writer { state: Arc::new(state), queues: Routes::default(), publishing: 0 };
        let shared = Shared {
            dictionary,
            commit: Mutex::new(writer),
            published: ArcSwapOption::empty(),
            taken: AtomicBool::new(false),
            waited: AtomicBool::new(false),
        };
        Self { shared: Arc::new(shared) }
    }

    /// The dictionary.
    pub fn dictionary(&self) -> Arc<Dictionary> {
        Arc::clone(&self.shared.dictionary)
    }

    /// The present state.
    pub fn snapshot(&self) -> Snapshot {
        let shared = &*self.shared;
        if let Some(state) = shared.published.load_full() {
            // Written only if it changes, so that readers do not take the line from each other.
            if !shared.taken.load(Ordering::Relaxed) {
                shared.taken.store(true, Ordering::Relaxed);
            }
            return Snapshot::new(state);
        }
        let writer = match shared.commit.try_lock() {
            Ok(writer) => writer,
            Err(_) => {
                shared.waited.store(true, Ordering::Relaxed);
                self.lock()
            }
        };
        shared.published.store(Some(Arc::clone(&writer.state)));
        Snapshot::new(Arc::clone(&writer.state))
    }

    /// Applies a transaction, as a whole or not at all.
    pub fn commit(&self, transaction: &Transaction, time: Time) -> Result<Commit, TransactionError> {
        let mut wakers = Vec::new();
        // What was published is let go of after the lock, not under it: freeing it may take a while.
        let mut before = None;
        let mut guard = self.lock();
        let writer = &mut *guard;
        transaction.stale_at(writer.state.version)?;
        self.prepare(writer, transaction);
        let outcome = transact(Arc::make_mut(&mut writer.state), transaction, time);
        if writer.publishing > 0 {
            before = self.shared.published.swap(Some(Arc::clone(&writer.state)));
        }
        let outcome = outcome?;
        let snapshot = Snapshot::new(Arc::clone(&writer.state));
        let delta = Arc::new(outcome.delta);
        let published = !(delta.changes.is_empty() && delta.reflexes.is_empty());
        if published && !writer.queues.is_empty() {
            let committed = Committed { delta: Arc::clone(&delta), snapshot: snapshot.clone() };
            writer.queues.concerned(&delta, &writer.state, |queue| wakers.extend(queue.push(&committed)));
        }
        drop(guard);
        drop(before);
        for waker in wakers {
            waker();
        }
        Ok(Commit { version: delta.version, delta, snapshot, guards: outcome.guards })
    }

    /// Decides whether there is a published state while this transaction is applied.
    fn prepare(&self, writer: &mut Writer, transaction: &Transaction) {
        let shared = &*self.shared;
        let waited = shared.waited.load(Ordering::Relaxed) && shared.waited.swap(false, Ordering::Relaxed);
        let taken = shared.taken.load(Ordering::Relaxed) && shared.taken.swap(false, Ordering::Relaxed);
        if waited || (taken && writer.publishing > 0) {
            writer.publishing = PUBLISHED;
        } else {
            writer.publishing = writer.publishing.saturating_sub(1);
        }
        if transaction.edits.len() > LONG {
            writer.publishing = writer.publishing.max(1);
        }
        let published = shared.published.load().is_some();
        if published && writer.publishing == 0 {
            shared.published.store(None);
        } else if !published && writer.publishing > 0 {
            shared.published.store(Some(Arc::clone(&writer.state)));
        }
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
        let queue = Queue::new(capacity);
        let start = self.register(&queue, Some(Arc::clone(&pattern)));
        Matches::new(queue, pattern, start)
    }

    /// Tells every commit from now on.
    pub fn subscribe_deltas(&self) -> Deltas {
        self.subscribe_deltas_with(CAPACITY)
    }

    /// The same, with a queue of this capacity.
    pub fn subscribe_deltas_with(&self, capacity: NonZeroUsize) -> Deltas {
        let queue = Queue::new(capacity);
        let start = self.register(&queue, None);
        Deltas { queue, start }
    }

    /// Under the commit lock, so that no commit falls between the snapshot and the first event.
    fn register(&self, queue: &Arc<Queue>, pattern: Option<Arc<Pattern>>) -> Snapshot {
        let mut guard = self.lock();
        let writer = &mut *guard;
        writer.queues.add(queue, pattern, &writer.state);
        Snapshot::new(Arc::clone(&writer.state))
    }

    /// A panic under the lock is a bug, but not a reason to stop the robot: what was begun is taken back.
    fn lock(&self) -> MutexGuard<'_, Writer> {
        self.shared.commit.lock().unwrap_or_else(|poisoned| {
            let mut writer = poisoned.into_inner();
            Arc::make_mut(&mut writer.state).abandon();
            self.shared.commit.clear_poison();
            writer
        })
    }
}

impl std::fmt::Debug for Graph {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Graph").field("version", &self.snapshot().version()).finish_non_exhaustive()
    }
}
