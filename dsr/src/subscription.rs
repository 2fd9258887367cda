//! Subscriptions: who wants to know gets told, and nobody ever waits for who does not listen.
//!
//! Idea: a commit only puts its delta and a reference to the new state into the queues whose pattern it may concern
//! (`routes`); the subscriber matches, on its own thread and in its own time, from the changed edge outwards
//! (`pattern::seed`). Invariant: what a subscriber holds is what matching its pattern from scratch would give.
//!
//! Overflow: a queue that is full is emptied, and from then on keeps one thing, the newest state, until its subscriber
//! comes for it: so a pattern subscriber misses intermediate matches but never ends up with a wrong set of them, and
//! one that never comes holds old states only until its queue is full, and commits do not copy around them for ever.
//! Waking: a blocked `recv` by a condition variable, anything else (an async task) by a callback; both after the
//! commit's lock and the queue's are given back, so that who wakes finds neither taken. What an emptied queue held is
//! freed then too.

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

/// How many commits a queue holds unless the subscriber says otherwise.
pub(crate) const CAPACITY: NonZeroUsize = NonZeroUsize::new(1024).expect("not zero");

type Waker = Arc<dyn Fn() + Send + Sync>;

/// A commit, as subscribers get it.
#[derive(Debug, Clone)]
pub struct Committed {
    /// What changed.
    pub delta: Arc<Delta>,
    /// The state that it led to.
    pub snapshot: Snapshot,
}

/// What a subscription to all deltas gives.
#[derive(Debug, Clone)]
pub enum Event {
    /// The next commit.
    Committed(Committed),
    /// Commits were dropped because the queue was full; the next ones follow on this state.
    Lagged {
        /// How many commits were dropped, this one included.
        missed: u64,
        /// The state to resynchronise from.
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

/// What a subscriber is told of commits that came since it last looked.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub enum Delivery {
    /// Each commit by itself, in order.
    #[default]
    Each,
    /// All of them as one: what appeared and went again in between is not told. For who acts on what is, not on what
    /// was. Only the newest state is kept.
    Newest,
}

/// So many that nobody counts them.
const FEW: usize = 64;

/// How a subscription's queue is kept.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Mailbox {
    /// How many commits it holds; when there are more, the subscriber goes on from the newest state.
    pub capacity: NonZeroUsize,
    /// What the subscriber is told.
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
    /// With the state after each, or only the last one's.
    commits: VecDeque<(Arc<Delta>, Option<Snapshot>)>,
    /// The state before the first of them, until that is taken or missed.
    start: Option<Snapshot>,
    missed: u64,
    closed: bool,
    /// How many threads wait in `recv`.
    asleep: u32,
    waker: Option<Waker>,
}

/// What a queue let go of: to be freed when no lock is held any more.
#[derive(Default)]
struct Freed {
    commits: VecDeque<(Arc<Delta>, Option<Snapshot>)>,
    start: Option<Snapshot>,
}

/// What is left to do for a queue when no lock is held any more.
pub(crate) struct Wake {
    sleeper: Option<Arc<Queue>>,
    waker: Option<Waker>,
    _freed: Freed,
}

impl Wake {
    /// Wakes the subscriber. A callback that panics is its subscriber's loss, not the committer's.
    pub(crate) fn call(self) {
        if let Some(queue) = &self.sleeper {
            queue.ready.notify_all();
        }
        if let Some(waker) = &self.waker {
            let _ = catch_unwind(AssertUnwindSafe(|| waker()));
        }
    }
}

/// What a queue gives.
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

    /// Begins with a state. Under the commit lock, before the first commit is told.
    pub(crate) fn begin(&self, start: Snapshot) {
        self.content().start = Some(start);
    }

    fn start(&self) -> Option<Snapshot> {
        self.content().start.clone()
    }

    fn take_start(&self) -> Option<Snapshot> {
        self.content().start.take()
    }

    /// Takes note of a commit; gives what to do later.
    pub(crate) fn push(self: &Arc<Self>, committed: &Committed) -> Option<Wake> {
        let mut content = self.content();
        let mut freed = Freed::default();
        // Who has not looked yet and wants what is, not what was, begins with this.
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
        // No code of others runs under this lock, so a poisoned one still holds a whole queue.
        self.content.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// What is told next; and the first state, if that is of no use any more: to be freed when no lock is held.
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
        // The last state of what is told; in between there may be none.
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
        // What a callback owns may commit when it goes: no lock is held here.
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
    /// What a subscriber of deltas gets, whose commits are told one by one.
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
    /// The state on which the first event follows. `None` when that has been taken, or when so many commits wait that
    /// they will be told as missed: nobody keeps an old state who does not look at it.
    pub fn start(&self) -> Option<Snapshot> {
        self.queue.start()
    }

    /// The next event, if there is one.
    pub fn try_recv(&self) -> Option<Event> {
        self.queue.try_recv().map(Told::event)
    }

    /// Waits for the next event; `None` when all handles of the graph are gone.
    pub fn recv(&self) -> Option<Event> {
        self.queue.recv().map(Told::event)
    }

    /// Calls `wake` whenever there may be something to receive, and now if there is.
    pub fn on_wake(&self, wake: impl Fn() + Send + Sync + 'static) {
        self.queue.on_wake(&(Arc::new(wake) as Waker));
    }

    /// Whether nothing will ever come again.
    pub fn is_closed(&self) -> bool {
        self.queue.is_closed()
    }
}

/// How the matches of a pattern changed.
#[derive(Debug, Clone)]
pub struct MatchChange {
    /// The version in which they did.
    pub version: Version,
    /// Matches that were not there before, in order.
    pub appeared: Vec<Binding>,
    /// Matches that are no longer there, in order.
    pub disappeared: Vec<Binding>,
    /// The state of that version.
    pub snapshot: Snapshot,
    /// How many commits were not looked at, because the queue was full.
    pub missed: u64,
}

/// The matches of a pattern, as they change. The first change has everything that matched at the start.
pub struct Matches {
    queue: Arc<Queue>,
    pattern: Arc<Pattern>,
    held: Held,
    plans: Plans,
    /// Who keeps what from being a match.
    witnesses: Witnesses,
    /// How much there was to look at when all matches were looked at last.
    whole: usize,
    /// Whether anything was looked at yet.
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

    /// The next change, if there is one. Commits that change no match are passed over.
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

    /// Waits for the next change; `None` when all handles of the graph are gone.
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

    /// The state of the beginning, once; the first commit that is told may be the beginning instead.
    fn begin(&mut self) -> Option<Told> {
        if std::mem::replace(&mut self.begun, true) {
            return None;
        }
        self.queue.take_start().map(|snapshot| Told::Lagged { missed: 0, snapshot })
    }

    /// Calls `wake` whenever there may be something to receive, and now if there is.
    pub fn on_wake(&self, wake: impl Fn() + Send + Sync + 'static) {
        if !self.begun {
            wake();
        }
        self.queue.on_wake(&(Arc::new(wake) as Waker));
    }

    /// Whether nothing will ever come again.
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
                // What several commits concern is what each of them does, looked at once, in the last one's state.
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
                    // Of bindings that nobody asks about any more; a look at everything makes no more than it looks at.
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
        // With what is known, it may be less than it will be without.
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

    /// Looks at slices one by one, as long as that is less than looking at all matches was when it was last done: so
    /// it never costs twice as much as the better of the two, by that measure.
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
            // A slice is at least one look.
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

    /// Holds the matches with these nodes against those held with these nodes.
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
