//! The matches of one pattern, kept up to date from delta to delta.
//!
//! Idea: a delta gives nodes to some variables of the pattern (`pattern::seed`); only matches with these nodes are
//! matched again. Invariant: what is held is what matching the pattern from scratch would give, except for matches in
//! the band of a hysteresis. Cost: never more than twice the cheaper of the two ways, counted in nodes looked at.

use std::cell::Cell;
use std::collections::BTreeSet;
use std::sync::Arc;

use crate::delta::{Change, Delta};
use crate::pattern::{Binding, Fixed, Held, Known, Moves, Pattern, Plans, Slices, Witnesses};
use crate::snapshot::Snapshot;

/// Up to this number, witnesses are always kept.
const FEW: usize = 64;

/// The matches that appeared and those that disappeared, each in order.
#[derive(Debug, Default)]
pub(super) struct Difference {
    pub(super) appeared: Vec<Binding>,
    pub(super) disappeared: Vec<Binding>,
}

impl Difference {
    pub(super) fn is_empty(&self) -> bool {
        self.appeared.is_empty() && self.disappeared.is_empty()
    }
}

/// One pattern and its matches.
pub(super) struct Tracker {
    pattern: Arc<Pattern>,
    held: Held,
    plans: Plans,
    /// For each binding that a negated part excludes, the nodes that do so.
    witnesses: Witnesses,
    /// The cost of the last matching from scratch, in nodes tried.
    whole: usize,
}

impl Tracker {
    pub(super) fn new(pattern: Arc<Pattern>) -> Self {
        let (held, plans, witnesses) = (Held::new(&pattern), Plans::default(), Witnesses::default());
        Self { pattern, held, plans, witnesses, whole: 0 }
    }

    pub(super) fn pattern(&self) -> &Arc<Pattern> {
        &self.pattern
    }

    pub(super) fn held(&self) -> &BTreeSet<Binding> {
        self.held.all()
    }

    /// Matches from scratch in a state that does not follow on the last one.
    pub(super) fn restart(&mut self, snapshot: &Snapshot) -> Difference {
        let mut difference = Difference::default();
        self.witnesses = Witnesses::default();
        self.match_all(snapshot, None, &mut difference.appeared, &mut difference.disappeared);
        difference
    }

    /// Matches the slices that these deltas may have changed; the snapshot is the state after the last one.
    pub(super) fn follow(&mut self, deltas: &[Arc<Delta>], snapshot: &Snapshot) -> Difference {
        let Difference { mut appeared, mut disappeared } = Difference::default();
        if !self.pattern.concerned_by(deltas.iter().map(|delta| &**delta)) {
            return Difference { appeared, disappeared };
        }
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
            Slices::All => self.match_all(snapshot, moves.as_ref(), &mut appeared, &mut disappeared),
            Slices::These(slices) => {
                self.match_slices(&slices, snapshot, moves.as_ref(), &mut appeared, &mut disappeared);
            }
        }
        if let Some(moves) = moves {
            self.witnesses = moves.witnesses.into_inner();
            // Most of them are then of bindings that are no longer matched: matching from scratch finds at most as many
            // witnesses as it tries nodes.
            if self.witnesses.len() > self.whole.max(FEW) {
                self.witnesses = Witnesses::default();
            }
        }
        Difference { appeared, disappeared }
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
