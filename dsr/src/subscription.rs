//! Subscriptions: every subscriber gets what concerns it, and no writer waits for a subscriber.
//!
//! Idea: a commit only puts its delta, and a reference to the new state, into the queues whose pattern it may concern
//! (`routes`). The subscriber matches on its own thread and in its own time, from the changed edge outwards
//! (`pattern::seed`). Invariant: the matches that a subscriber holds are those of matching its pattern from scratch.
//!
//! Overflow: a full queue is emptied, and from then on keeps only the newest state until its subscriber reads it. So a
//! pattern subscriber may miss intermediate matches but never holds a wrong set of them; and a subscriber that never
//! reads keeps old states only until its queue is full, so commits do not copy around them for ever.
//!
//! Waking: a blocked `recv` is woken by a condition variable, anything else (an async task) by a callback. Both happen
//! after the commit's lock and the queue's lock are released, so the woken thread finds neither taken. The content of
//! an emptied queue is freed then, too.

use std::cell::Cell;
use std::collections::{BTreeSet, VecDeque};
use std::num::NonZeroUsize;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::{Arc, Condvar, Mutex, PoisonError};

use smallvec::SmallVec;

use crate::delta::{Change, Delta};
use crate::id::Version;
use crate::pattern::{Binding, Fixed, Held, Known, Moves, Pattern, Plans, Slices, Witnesses};
use crate::snapshot::Snapshot;

/// The default capacity of a queue, in commits.
pub(crate) const CAPACITY: NonZeroUsize = NonZeroUsize::new(1024).expect("not zero");

type Waker = Arc<dyn Fn() + Send + Sync>;

/// A commit, as subscribers receive it.
#[derive(Debug, Clone)]
pub struct Committed {
    /// What changed.
    pub delta: Arc<Delta>,
    /// The state after it.
    pub snapshot: Snapshot,
}

/// An event of a subscription to all deltas.
#[derive(Debug, Clone)]
pub enum Event {
    /// The next commit.
    Committed(Committed),
    /// Commits were dropped because the queue was full. The next event follows this state.
    Lagged {
        /// The number of commits that were dropped, including the one of this state.
        missed: u64,
        /// The state from which to continue.
        snapshot: Snapshot,
    },
}

impl Event {
    /// The state after the event.
    pub fn snapshot(&self) -> &Snapshot {
        match self {
            Self::Committed(committed) => &committed.snapshot,
            Self::Lagged { snapshot, .. } => snapshot,
        }
    }
}

/// How a subscriber receives the commits since its last read.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub enum Delivery {
    /// One by one, in order.
    #[default]
    Each,
    /// All of them as one. A match that appeared and disappeared in between is not reported. For subscribers that act
    /// on the present state, not on its history. Only the newest state is kept.
    Newest,
}

/// Up to this number, witnesses are always kept.
const FEW: usize = 64;

/// The settings of a subscription's queue.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Mailbox {
    /// The most commits that it holds. Beyond, the subscriber continues from the newest state.
    pub capacity: NonZeroUsize,
    /// How the subscriber receives commits.
    pub delivery: Delivery,
}

impl Default for Mailbox {
    fn default() -> Self {
        Self { capacity: CAPACITY, delivery: Delivery::Each }
    }
}

impl From<NonZeroUsize> for Mailbox {
    fn from(capacity: NonZeroUsize) -> Self {
        Self { capacity, ..Self::default() }
    }
}

impl From<Delivery> for Mailbox {
    fn from(delivery: Delivery) -> Self {
        Self { delivery, ..Self::default() }
    }
}

/// The writers' end of one subscription.
pub(crate) struct Queue {
    content: Mutex<Content>,
    ready: Condvar,
    mailbox: Mailbox,
}

#[derive(Default)]
struct Content {
    /// Each with the state after it; with [`Delivery::Newest`], only the last one has a state.
    commits: VecDeque<(Arc<Delta>, Option<Snapshot>)>,
    /// The state before the first commit, until it is read or missed.
    start: Option<Snapshot>,
    missed: u64,
    closed: bool,
    /// The number of threads that wait in `recv`.
    asleep: u32,
    waker: Option<Waker>,
}

/// The old content of a queue, to be freed after the locks are released.
#[derive(Default)]
struct Freed {
    commits: VecDeque<(Arc<Delta>, Option<Snapshot>)>,
    start: Option<Snapshot>,
}

/// What remains to be done for a queue after the locks are released.
pub(crate) struct Wake {
    sleeper: Option<Arc<Queue>>,
    waker: Option<Waker>,
    _freed: Freed,
}

impl Wake {
    /// Wakes the subscriber. The panic of a callback does not reach the committer.
    pub(crate) fn call(self) {
        if let Some(queue) = &self.sleeper {
            queue.ready.notify_all();
        }
        if let Some(waker) = &self.waker {
            let _ = catch_unwind(AssertUnwindSafe(|| waker()));
        }
    }
}

/// What a queue returns.
enum Told {
    /// These commits led to this state.
    Commits(SmallVec<[Arc<Delta>; 1]>, Snapshot),
    Lagged {
        missed: u64,
        snapshot: Snapshot,
    },
}

impl Queue {
    pub(crate) fn new(mailbox: Mailbox) -> Arc<Self> {
        Arc::new(Self { content: Mutex::default(), ready: Condvar::new(), mailbox })
    }

    /// Sets the first state. Called under the commit lock, before the first commit is pushed.
    pub(crate) fn begin(&self, start: Snapshot) {
        self.content().start = Some(start);
    }

    fn start(&self) -> Option<Snapshot> {
        self.content().start.clone()
    }

    fn take_start(&self) -> Option<Snapshot> {
        self.content().start.take()
    }

    /// Adds a commit. Returns what remains to be done after the locks are released.
    pub(crate) fn push(self: &Arc<Self>, committed: &Committed) -> Option<Wake> {
        let mut content = self.content();
        let mut freed = Freed::default();
        // A subscriber to the newest state that has not read the first one yet begins with this one instead.
        if self.mailbox.delivery == Delivery::Newest && content.start.is_some() {
            freed.start = content.start.replace(committed.snapshot.clone());
            return self.wake(&content, freed);
        }
        if content.missed > 0 || content.commits.len() >= self.mailbox.capacity.get() {
            content.missed += content.commits.len() as u64;
            freed = Freed { commits: std::mem::take(&mut content.commits), start: content.start.take() };
        } else if self.mailbox.delivery == Delivery::Newest
            && let Some((delta, before)) = content.commits.back_mut()
        {
            freed.commits.push_back((Arc::clone(delta), before.take()));
        }
        content.commits.push_back((Arc::clone(&committed.delta), Some(committed.snapshot.clone())));
        self.wake(&content, freed)
    }

    pub(crate) fn close(self: &Arc<Self>) -> Option<Wake> {
        let mut content = self.content();
        content.closed = true;
        self.wake(&content, Freed::default())
    }

    fn wake(self: &Arc<Self>, content: &Content, freed: Freed) -> Option<Wake> {
        let sleeper = (content.asleep > 0).then(|| Arc::clone(self));
        let waker = content.waker.clone();
        let nothing =
            sleeper.is_none() && waker.is_none() && freed.commits.is_empty() && freed.start.is_none();
        (!nothing).then_some(Wake { sleeper, waker, _freed: freed })
    }

    fn content(&self) -> std::sync::MutexGuard<'_, Content> {
        // No callback runs under this lock, so a poisoned lock still guards a consistent queue.
        self.content.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// The next item; and the first state, which is no longer needed, to be freed after the lock is released.
    fn pop(content: &mut Content) -> Option<(Told, Option<Snapshot>)> {
        if content.commits.is_empty() {
            return None;
        }
        let start = content.start.take();
        Self::next(content).map(|told| (told, start))
    }

    fn next(content: &mut Content) -> Option<Told> {
        let missed = std::mem::take(&mut content.missed);
        let mut deltas = SmallVec::new();
        // Commits without a state are delivered together with the next one that has a state.
        while let Some((delta, snapshot)) = content.commits.pop_front() {
            deltas.push(delta);
            if let Some(snapshot) = snapshot {
                return Some(if missed == 0 {
                    Told::Commits(deltas, snapshot)
                } else {
                    Told::Lagged { missed: missed + 1, snapshot }
                });
            }
        }
        None
    }

    fn try_recv(&self) -> Option<Told> {
        let popped = Self::pop(&mut self.content());
        popped.map(|(told, _)| told)
    }

    fn recv(&self) -> Option<Told> {
        let mut content = self.content();
        loop {
            if let Some((told, start)) = Self::pop(&mut content) {
                drop(content);
                drop(start);
                return Some(told);
            }
            if content.closed {
                return None;
            }
            content.asleep += 1;
            content = self.ready.wait(content).unwrap_or_else(PoisonError::into_inner);
            content.asleep -= 1;
        }
    }

    fn on_wake(&self, waker: &Waker) {
        let (pending, before) = {
            let mut content = self.content();
            let before = content.waker.replace(Arc::clone(waker));
            let pending = !content.commits.is_empty() || content.closed;
            (pending, before)
        };
        // Dropping a callback may commit, so no lock is held here.
        drop(before);
        if pending {
            waker();
        }
    }

    fn is_closed(&self) -> bool {
        let content = self.content();
        content.closed && content.commits.is_empty()
    }
}

impl Told {
    /// As the event of a subscription to all deltas, which receives commits one by one.
    fn event(self) -> Event {
        match self {
            Self::Commits(deltas, snapshot) => match deltas.into_iter().next() {
                Some(delta) => Event::Committed(Committed { delta, snapshot }),
                None => Event::Lagged { missed: 0, snapshot },
            },
            Self::Lagged { missed, snapshot } => Event::Lagged { missed, snapshot },
        }
    }
}

/// Every commit from the one after [`Deltas::start`] on.
pub struct Deltas {
    pub(crate) queue: Arc<Queue>,
}

impl Deltas {
    /// The state before the first event. `None` after the first event was read, or when the queue has overflowed: a
    /// subscriber that does not read must not keep an old state in memory.
    pub fn start(&self) -> Option<Snapshot> {
        self.queue.start()
    }

    /// The next event, if one is waiting.
    pub fn try_recv(&self) -> Option<Event> {
        self.queue.try_recv().map(Told::event)
    }

    /// Waits for the next event; `None` after all handles of the graph were dropped.
    pub fn recv(&self) -> Option<Event> {
        self.queue.recv().map(Told::event)
    }

    /// Calls `wake` whenever there may be something to receive, and at once if there is.
    pub fn on_wake(&self, wake: impl Fn() + Send + Sync + 'static) {
        self.queue.on_wake(&(Arc::new(wake) as Waker));
    }

    /// Whether no event will ever come again.
    pub fn is_closed(&self) -> bool {
        self.queue.is_closed()
    }
}

/// A change of the matches of a pattern.
#[derive(Debug, Clone)]
pub struct MatchChange {
    /// The version of the change.
    pub version: Version,
    /// The new matches, in order.
    pub appeared: Vec<Binding>,
    /// The matches that no longer hold, in order.
    pub disappeared: Vec<Binding>,
    /// The state of that version.
    pub snapshot: Snapshot,
    /// The number of commits that were dropped because the queue was full.
    pub missed: u64,
}

/// A subscription to the matches of a pattern. The first change has all matches at the start.
pub struct Matches {
    queue: Arc<Queue>,
    pattern: Arc<Pattern>,
    held: Held,
    plans: Plans,
    /// For each binding that a negated part excludes, the nodes that do so.
    witnesses: Witnesses,
    /// The cost of the last matching from scratch, in nodes tried.
    whole: usize,
    /// Whether the first state was read.
    begun: bool,
}

impl Matches {
    pub(crate) fn new(queue: Arc<Queue>, pattern: Arc<Pattern>) -> Self {
        let (held, plans, witnesses) = (Held::new(&pattern), Plans::default(), Witnesses::default());
        Self { queue, pattern, held, plans, witnesses, whole: 0, begun: false }
    }

    /// The pattern.
    pub fn pattern(&self) -> &Arc<Pattern> {
        &self.pattern
    }

    /// The matches after the changes received so far.
    pub fn held(&self) -> &BTreeSet<Binding> {
        self.held.all()
    }

    /// The next change, if one is waiting. Commits that change no match are skipped.
    pub fn try_recv(&mut self) -> Option<MatchChange> {
        loop {
            let told = match self.begin() {
                Some(told) => told,
                None => self.queue.try_recv()?,
            };
            if let Some(change) = self.look(told) {
                return Some(change);
            }
        }
    }

    /// Waits for the next change; `None` after all handles of the graph were dropped.
    pub fn recv(&mut self) -> Option<MatchChange> {
        loop {
            let told = match self.begin() {
                Some(told) => told,
                None => self.queue.recv()?,
            };
            if let Some(change) = self.look(told) {
                return Some(change);
            }
        }
    }

    /// The first state, once. After an overflow there is none, and the first item of the queue replaces it.
    fn begin(&mut self) -> Option<Told> {
        if std::mem::replace(&mut self.begun, true) {
            return None;
        }
        self.queue.take_start().map(|snapshot| Told::Lagged { missed: 0, snapshot })
    }

    /// Calls `wake` whenever there may be something to receive, and at once if there is.
    pub fn on_wake(&self, wake: impl Fn() + Send + Sync + 'static) {
        if !self.begun {
            wake();
        }
        self.queue.on_wake(&(Arc::new(wake) as Waker));
    }

    /// Whether no event will ever come again.
    pub fn is_closed(&self) -> bool {
        self.begun && self.queue.is_closed()
    }

    fn look(&mut self, told: Told) -> Option<MatchChange> {
        let (mut appeared, mut disappeared) = (Vec::new(), Vec::new());
        let (snapshot, missed) = match told {
            Told::Lagged { missed, snapshot } => {
                self.witnesses = Witnesses::default();
                self.match_all(&snapshot, None, &mut appeared, &mut disappeared);
                (snapshot, missed)
            }
            Told::Commits(deltas, snapshot) => {
                // The slices of several commits are those of each, all matched once in the last state.
                let deltas = deltas.iter().map(|delta| &**delta);
                let mut changes = deltas.clone().flat_map(|delta| &delta.changes);
                if changes.any(|change| matches!(change, Change::NodeRemoved { .. })) {
                    self.witnesses.forget(snapshot.state());
                }
                let (slices, moves) = self.pattern.slices(deltas, snapshot.state(), self.whole);
                if let Some(moves) = &moves {
                    moves.witnesses.replace(std::mem::take(&mut self.witnesses));
                }
                match slices {
                    Slices::All => self.match_all(&snapshot, moves.as_ref(), &mut appeared, &mut disappeared),
                    Slices::These(slices) => {
                        let moves = moves.as_ref();
                        self.match_slices(&slices, &snapshot, moves, &mut appeared, &mut disappeared);
                    }
                }
                if let Some(moves) = moves {
                    self.witnesses = moves.witnesses.into_inner();
                    // Most of them are then of bindings that are no longer matched: matching from scratch finds at most
                    // as many witnesses as it tries nodes.
                    if self.witnesses.len() > self.whole.max(FEW) {
                        self.witnesses = Witnesses::default();
                    }
                }
                (snapshot, 0)
            }
        };
        if appeared.is_empty() && disappeared.is_empty() && missed == 0 {
            return None;
        }
        Some(MatchChange { version: snapshot.version(), appeared, disappeared, snapshot, missed })
    }

    fn match_all(
        &mut self,
        snapshot: &Snapshot,
        moves: Option<&Moves<'_>>,
        appeared: &mut Vec<Binding>,
        disappeared: &mut Vec<Binding>,
    ) {
        let (state, held) = (snapshot.state(), self.held.all());
        let looked = Cell::new(1 + held.len());
        let known = moves.map(|moves| Known { moves, held: &self.held });
        let found = self.pattern.matches_known(state, known.as_ref(), &looked);
        let looked = looked.get() + found.len();
        // With knowledge about negated parts, this may cost less than the next time without.
        self.whole = if known.is_some() { self.whole.max(looked) } else { looked };
        let mut now: BTreeSet<_> = found.into_iter().collect();
        let stays = |held: &&Binding| !now.contains(*held) && self.pattern.keeps(state, held);
        let staying: Vec<_> = held.iter().filter(stays).cloned().collect();
        now.extend(staying);
        let gone: Vec<_> = held.difference(&now).cloned().collect();
        let new: Vec<_> = now.difference(held).cloned().collect();
        gone.iter().for_each(|binding| self.held.lose(binding));
        new.iter().for_each(|binding| self.held.find(binding));
        appeared.extend(new);
        disappeared.extend(gone);
    }

    /// Matches slices one by one, as long as this costs less than the last matching from scratch did. So it never costs
    /// more than twice the better of the two.
    fn match_slices(
        &mut self,
        slices: &[Fixed],
        snapshot: &Snapshot,
        moves: Option<&Moves<'_>>,
        appeared: &mut Vec<Binding>,
        disappeared: &mut Vec<Binding>,
    ) {
        let looked = Cell::new(0);
        for (at, fixed) in slices.iter().enumerate() {
            // A slice tries at least one node.
            if at > 0 && looked.get() + (slices.len() - at) > self.whole {
                self.match_all(snapshot, moves, appeared, disappeared);
                break;
            }
            looked.set(looked.get() + 1);
            let now = {
                let known = moves.map(|moves| Known { moves, held: &self.held });
                let plans = &mut self.plans;
                self.pattern.matches_of(snapshot.state(), fixed, plans, known.as_ref(), &looked)
            };
            self.match_slice(fixed, now, snapshot, appeared, disappeared);
        }
        appeared.sort_unstable();
        disappeared.sort_unstable();
    }

    /// Compares the matches with these nodes with the held ones.
    fn match_slice(
        &mut self,
        fixed: &Fixed,
        now: Vec<Binding>,
        snapshot: &Snapshot,
        appeared: &mut Vec<Binding>,
        disappeared: &mut Vec<Binding>,
    ) {
        let held = self.held.with(fixed);
        let gone: Vec<_> = held
            .filter(|held| now.binary_search(held).is_err() && !self.pattern.keeps(snapshot.state(), held))
            .cloned()
            .collect();
        gone.iter().for_each(|binding| self.held.lose(binding));
        disappeared.extend(gone);
        for binding in now {
            if !self.held.all().contains(&binding) {
                self.held.find(&binding);
                appeared.push(binding);
            }
        }
    }
}
