//! The graph: one handle, one lock for writers, none for readers.
//!
//! Idea: `left_right` keeps two states that writers edit in turn. This module says how one state follows the other, by
//! the delta that the commit publishes anyway, and when not: after a transaction so long that following costs more than
//! a copy, the next writer copies what it edits. Either way a snapshot is one load, whatever writers do. Cost: what was
//! written since the last such transaction is in memory twice.
//!
//! Invariants: the published state is the present version. Versions have no gaps. Subscribers get commits in order, and
//! a subscriber that receives a commit finds it in the graph. A transaction that changes nothing makes no version and
//! wakes no subscriber. No callback runs under the lock.

use std::num::NonZeroUsize;
use std::sync::{Arc, Weak};

use smallvec::SmallVec;

use crate::delta::Delta;
use crate::epochs::Epochs;
use crate::export::{self, Export, RestoreError};
use crate::id::{AgentId, Epoch, ReflexId, Time, Version};
use crate::interest::Interest;
use crate::journal::feed::{Entry, Feed, Present, Rest};
use crate::left_right::{LeftRight, Twin, Writing};
use crate::past::Past;
use crate::pattern::Pattern;
use crate::replay::{self, ReplayError};
use crate::routes::Routes;
use crate::snapshot::Snapshot;
use crate::state::State;
use crate::subscription::{Committed, Deltas, Mailbox, Matches, Queue, Subscription, Wake};
use crate::transaction::commit::{transact, warm};
use crate::transaction::reflexes::{Guard, Registry};
use crate::transaction::{Edit, Transaction, TransactionError};
use crate::vocabulary::Vocabulary;

/// The result of a successful commit.
#[derive(Debug, Clone)]
pub struct Commit {
    /// The version in which the transaction's content holds: a new one, or the present one if nothing changed.
    pub version: Version,
    /// What changed, including the edits of reflexes.
    pub delta: Arc<Delta>,
    /// The state after the commit.
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
    vocabulary: Arc<Vocabulary>,
    past: Past,
    states: LeftRight<State, Writers>,
}

/// Data that only writers use, under the lock.
struct Writers {
    version: Version,
    reflexes: Registry,
    queues: Routes,
    /// The journals that receive each delta.
    feeds: Vec<Arc<Feed>>,
    epochs: Epochs,
}

impl Writers {
    /// Hands a commit to the journals.
    fn record(&mut self, transaction: &Transaction, guards: &[ReflexId], delta: &Arc<Delta>) {
        if self.feeds.is_empty() {
            return;
        }
        let registered = guards.iter().filter_map(|id| self.reflexes.guard(*id)).collect();
        let dismissed = transaction.dismissed.clone();
        let entry = Entry { delta: Arc::clone(delta), registered, dismissed };
        if !entry.is_empty() {
            self.feeds.retain(|feed| feed.push(&entry));
        }
    }
}

impl Twin for State {
    type Change = Arc<Delta>;

    fn follow(&mut self, delta: &Arc<Delta>) -> bool {
        // A commit that only registers a reflex makes no version.
        delta.version == self.version || replay::follow(self, delta)
    }
}

/// After more changes than this, copying costs less than following the delta.
const LONG: usize = 64;

impl Drop for Shared {
    fn drop(&mut self) {
        let mut writing = self.states.write();
        let present = writing.present();
        let writers = writing.own();
        let reflexes = writers.reflexes.clone();
        writers.feeds.iter().for_each(|feed| feed.close(&present, &reflexes));
        let wakes: Vec<_> = writers.queues.queues().filter_map(|queue| queue.close()).collect();
        drop(writing);
        wakes.into_iter().for_each(Wake::call);
    }
}

/// A graph as its journal sees it: a reference that does not keep it alive.
#[derive(Clone)]
pub(crate) struct Observed(Weak<Shared>);

impl Observed {
    /// Empties the feed, and takes the state right after its content, so that no commit falls between the two.
    pub(crate) fn restart(&self, feed: &Feed) -> Option<(Rest, Present)> {
        let shared = self.0.upgrade()?;
        let mut writing = shared.states.write();
        let snapshot = Snapshot::new(writing.present());
        let found = (feed.restart(), Present { snapshot, reflexes: writing.own().reflexes.clone() });
        drop(writing);
        Some(found)
    }
}

impl Graph {
    /// A graph with the nodes that stand for the vocabulary's agents and resources, at version 0.
    pub fn new(vocabulary: Arc<Vocabulary>) -> Self {
        Self::with(State::new(vocabulary), Registry::default())
    }

    /// The graph of an export.
    pub fn restore(vocabulary: Arc<Vocabulary>, export: &Export) -> Result<Self, RestoreError> {
        Ok(Self::with(export::restore(vocabulary, export)?, Registry::default()))
    }

    /// The graph of an export and the deltas published after it.
    pub fn replay<'d>(
        vocabulary: Arc<Vocabulary>,
        initial: &Export,
        deltas: impl IntoIterator<Item = &'d Delta>,
    ) -> Result<Self, ReplayError> {
        let mut state = export::restore(vocabulary, initial)?;
        for delta in deltas {
            replay::apply(&mut state, delta)?;
        }
        Ok(Self::with(state, Registry::default()))
    }

    fn with(state: State, reflexes: Registry) -> Self {
        let vocabulary = Arc::clone(&state.vocabulary);
        let version = state.version;
        let writers = Writers {
            version,
            reflexes,
            queues: Routes::default(),
            feeds: Vec::new(),
            epochs: Epochs::default(),
        };
        Self {
            shared: Arc::new(Shared {
                vocabulary,
                past: Past::default(),
                states: LeftRight::new(state, writers),
            }),
        }
    }

    /// The vocabulary.
    pub fn vocabulary(&self) -> Arc<Vocabulary> {
        Arc::clone(&self.shared.vocabulary)
    }

    /// Whether both are handles on the same graph.
    pub fn is(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.shared, &other.shared)
    }

    /// The present state. Never waits.
    pub fn snapshot(&self) -> Snapshot {
        Snapshot::new(self.shared.states.read())
    }

    /// Keeps the last `count` versions before the present one for [`Graph::at`], from now on; by default none. Each
    /// costs the memory of what was written after it, and makes commits copy the pages that they edit.
    pub fn remember(&self, count: usize) {
        let writing = self.shared.states.write();
        let forgotten = self.shared.past.keep(count, &Snapshot::new(writing.present()));
        drop(writing);
        drop(forgotten);
    }

    /// The state at the present version or at one that [`Graph::remember`] kept. Older ones are in a journal: see
    /// [`Recording::at`](crate::Recording::at).
    pub fn at(&self, version: Version) -> Option<Snapshot> {
        let present = self.snapshot();
        if present.version() == version { Some(present) } else { self.shared.past.at(version) }
    }

    /// Applies a transaction, as a whole or not at all.
    pub fn commit(&self, transaction: &Transaction, time: Time) -> Result<Commit, TransactionError> {
        let mut writing = self.shared.states.write();
        writing.own().epochs.admit(transaction, &self.shared.vocabulary)?;
        transaction.stale_at(writing.own().version)?;
        if let Some(state) = writing.ahead() {
            warm(state, &transaction.edits);
        }
        let reflexes = writing.own().reflexes.clone();
        let outcome = match transact(writing.next(), reflexes, transaction, time) {
            Ok(outcome) => outcome,
            Err(error) => {
                writing.leave();
                return Err(error);
            }
        };
        let delta = Arc::new(outcome.delta);
        let owners = owners(&writing.own().reflexes, &delta);
        writing.own().reflexes = outcome.reflexes;
        writing.own().epochs.follow(transaction);
        writing.own().record(transaction, &outcome.guards, &delta);
        let snapshot = self.publish(writing, &delta, &owners);
        Ok(Commit { version: delta.version, delta, snapshot, guards: outcome.guards })
    }

    /// Takes a commit over from a recording, as a version of its own, with all its subscribers. Reflexes and journals
    /// stay as they are.
    pub(crate) fn follow(&self, delta: Delta) -> Result<(), ReplayError> {
        let mut writing = self.shared.states.write();
        if let Err(error) = replay::apply(writing.next(), &delta) {
            writing.leave();
            return Err(error);
        }
        self.publish(writing, &Arc::new(delta), &[]);
        Ok(())
    }

    /// Lets readers and subscribers see the next state.
    fn publish(
        &self,
        mut writing: Writing<'_, State, Writers>,
        delta: &Arc<Delta>,
        owners: &[AgentId],
    ) -> Snapshot {
        let (mut wakes, mut forgotten) = (Vec::new(), None);
        // If a subscriber is dropped meanwhile, this holds the last reference to its queue. The queue has a callback
        // and states, which must not be dropped under the lock.
        let mut queues = SmallVec::<[Arc<Queue>; 8]>::new();
        let changed = !(delta.changes.is_empty() && delta.reflexes.is_empty());
        let short = delta.changes.len() <= LONG;
        let (state, before) = writing.publish(short.then(|| Arc::clone(delta)));
        let snapshot = Snapshot::new(state);
        if changed {
            let writers = writing.own();
            writers.version = delta.version;
            forgotten = self.shared.past.push(&snapshot);
            if !writers.queues.is_empty() {
                let committed = Committed { delta: Arc::clone(delta), snapshot: snapshot.clone() };
                let tell = |queue: Arc<Queue>| {
                    wakes.extend(queue.push(&committed));
                    queues.push(queue);
                };
                writers.queues.concerned(delta, snapshot.state(), owners, tell);
            }
        }
        drop(writing);
        wakes.into_iter().for_each(Wake::call);
        // Freeing may take a while, so it happens after the lock is released and subscribers are woken.
        drop((before, forgotten, queues));
        snapshot
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

    /// Reads a snapshot, writes a transaction from it, and commits it on that very version. If another commit came
    /// first, `write` runs again with the newer snapshot. Each retry means that another commit succeeded, so the graph
    /// as a whole always makes progress.
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

    /// Begins the next life of an agent: what was written for an earlier one is refused from now on.
    pub(crate) fn begin_life(&self, agent: AgentId) -> Epoch {
        self.shared.states.write().own().epochs.next(agent)
    }

    /// Declares an agent dead: releases its leases, fires its reflexes, and ends its life.
    pub fn expire(&self, agent: AgentId, time: Time) -> Result<Commit, TransactionError> {
        self.edit(AgentId::DSR, time, |transaction| {
            transaction.push(Edit::Expire { agent });
        })
    }

    /// Reports the part of the graph that an interest asks for, beginning with the state of now.
    pub fn subscribe_to(&self, interest: impl Into<Interest>) -> Subscription {
        self.subscribe_to_with(interest, Mailbox::default())
    }

    /// The same, with a queue that is kept so.
    pub fn subscribe_to_with(
        &self,
        interest: impl Into<Interest>,
        mailbox: impl Into<Mailbox>,
    ) -> Subscription {
        let interest = Arc::new(interest.into());
        let queue = Queue::new(mailbox.into());
        self.register(&queue, Some(Arc::clone(&interest)));
        Subscription::new(queue, interest)
    }

    /// Subscribes to the matches of a pattern, beginning with the present ones.
    pub fn subscribe(&self, pattern: impl Into<Arc<Pattern>>) -> Matches {
        self.subscribe_with(pattern, Mailbox::default())
    }

    /// Like [`Graph::subscribe`], with settings for the queue.
    pub fn subscribe_with(&self, pattern: impl Into<Arc<Pattern>>, mailbox: impl Into<Mailbox>) -> Matches {
        Matches::new(self.subscribe_to_with(pattern.into(), mailbox))
    }

    /// Subscribes to every commit from now on.
    pub fn subscribe_deltas(&self) -> Deltas {
        self.subscribe_deltas_with(Mailbox::default().capacity)
    }

    /// Like [`Graph::subscribe_deltas`], with a queue of this capacity.
    pub fn subscribe_deltas_with(&self, capacity: NonZeroUsize) -> Deltas {
        let queue = Queue::new(capacity.into());
        self.register(&queue, None);
        Deltas::new(queue)
    }

    /// Under the commit lock, so that no commit falls between the snapshot and the first event.
    fn register(&self, queue: &Arc<Queue>, interest: Option<Arc<Interest>>) {
        let mut writing = self.shared.states.write();
        let present = writing.present();
        writing.own().queues.add(queue, interest, &present);
        queue.begin(Snapshot::new(present));
    }

    /// Sends every commit from now on to a feed. Returns the present state, with which the feed begins.
    pub(crate) fn attach(&self, feed: &Arc<Feed>) -> Present {
        let mut writing = self.shared.states.write();
        writing.own().feeds.push(Arc::clone(feed));
        let snapshot = Snapshot::new(writing.present());
        Present { snapshot, reflexes: writing.own().reflexes.clone() }
    }

    pub(crate) fn observed(&self) -> Observed {
        Observed(Arc::downgrade(&self.shared))
    }

    /// A new graph that continues from a snapshot. Reflexes stay with the old graph.
    pub fn from_snapshot(snapshot: &Snapshot) -> Self {
        Self::with(snapshot.state().clone(), Registry::default())
    }

    /// A graph that continues from a snapshot, with the reflexes of a journal.
    pub(crate) fn resumed(snapshot: &Snapshot, guards: impl IntoIterator<Item = Guard>) -> Self {
        Self::with(snapshot.state().clone(), Registry::restore(guards))
    }

    /// Replaces the registered reflexes by those of a journal.
    pub(crate) fn take_over(&self, guards: impl IntoIterator<Item = Guard>) {
        self.shared.states.write().own().reflexes = Registry::restore(guards);
    }
}

/// The agents whose reflexes fired in a commit; the registry is the one before it.
fn owners(before: &Registry, delta: &Delta) -> SmallVec<[AgentId; 2]> {
    // A reflex that was registered and fired in one commit is the writer's.
    let owner = |reflex: &ReflexId| before.owner(*reflex).unwrap_or(delta.writer);
    delta.reflexes.iter().map(owner).collect()
}

impl std::fmt::Debug for Graph {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Graph").field("version", &self.snapshot().version()).finish_non_exhaustive()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::vocabulary::{Nature, VocabularyBuilder};

    /// Deadlocks if a reader needs anything that a writer holds.
    #[test]
    fn a_snapshot_is_taken_while_a_writer_is_at_work() {
        let mut builder = VocabularyBuilder::new();
        let place = builder.node_type("place", None, Nature::Symbolic).expect("a new type");
        let graph = Graph::new(builder.build());
        let add = |name: &str| {
            graph.edit(AgentId::DSR, Time(0), |tx| _ = tx.add_node(name, place)).expect("a new node").version
        };
        for at in 0..5 {
            let version = add(&format!("n{at}"));
            let mut writing = graph.shared.states.write();
            let state = writing.next();
            state.insert_node(state.next, "half done".into(), place, version);
            let seen = graph.snapshot();
            assert_eq!((seen.version(), seen.node("half done")), (version, None));
            // Dropped as by a panic, with the state half edited: the next commits do not see the edit.
        }
        assert_eq!(add("last"), Version(6));
        assert_eq!(graph.snapshot().node("half done"), None);
    }
}
