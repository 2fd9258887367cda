//! Subscriptions to the matches of a pattern: after each commit, only the slices that it may have changed are matched again.

use std::cell::Cell;
use std::collections::BTreeSet;
use std::sync::Arc;

use super::queue::{Queue, Told, Waker};
use crate::delta::Change;
use crate::id::Version;
use crate::pattern::{Binding, Fixed, Held, Known, Moves, Pattern, Plans, Slices, Witnesses};
use crate::snapshot::Snapshot;

/// Up to this number, witnesses are always kept.
const FEW: usize = 64;

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
