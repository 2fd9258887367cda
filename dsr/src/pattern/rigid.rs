//! Which metrics may have changed: the tree of frames is divided into rigid groups.
//!
//! Problem: when an edge of the kinematic tree changes, matching every pattern with a metric again costs as much as the
//! graph is large, although a person who takes a step changes one distance in a thousand. Idea: label each frame with
//! the lowest changed edge at or above it, if any. The chain between two frames consists of their two paths to the root
//! without the part that these share, so it contains a changed edge if and only if their labels differ. Frames with the
//! same label are a rigid group: the metrics inside of it have not changed, and only pairs across two groups are
//! computed again. Each such pair has an end outside of any given group, so joins begin at the frames of all groups but
//! the largest one. If a person moves, the join begins at one frame. If a floor moves with everything on it, patterns
//! that measure only between things on it have no frame to begin at.
//!
//! Invariant: labels in the state after the changes are enough. A frame without a label has the same edges above it as
//! before; two frames with the same label have the same edges up to the labelled one. This holds for several deltas
//! together, with the moved frames of all.
//!
//! Cost: at most that of matching from scratch, which the caller gives as the budget, and at most the number of frames
//! that the pattern measures. Usually few frames are below the changed edges, and all of them are walked. If they are
//! more than the frames that the pattern can measure, the labels of the latter are looked up from below. If these are
//! too many as well, all matches are computed again. No history of distances is kept, so a frame that moves without
//! crossing a threshold costs the same.

use rustc_hash::FxHashMap;
use smallvec::SmallVec;

use super::compiled::Pattern;
use super::fixed::{Fixed, Slices};
use super::measure::End;
use crate::delta::Change;
use crate::id::{NodeId, TypeId};
use crate::state::State;

/// The frame whose edge to its parent is added, removed or moved by a change, if the frame still exists. A sample older
/// than the newest one moves nothing now.
pub(crate) fn moved(change: &Change, state: &State) -> Option<NodeId> {
    let child = match *change {
        Change::TransformAdded { child, .. }
        | Change::TransformChanged { child, .. }
        | Change::TransformRemoved { child, .. } => child,
        Change::TransformSampled { child, time, .. } => {
            state.joint(child).is_some_and(|joint| time >= joint.newest).then_some(child)?
        }
        _ => return None,
    };
    state.node(child).map(|_| child)
}

/// The lowest changed edge at or above a frame, named by the child of that edge.
type Label = Option<NodeId>;

/// For each group, the number of frames at either end.
type Tally = FxHashMap<Label, [usize; 2]>;

pub(super) struct Groups<'s> {
    state: &'s State,
    /// The frames whose edge to their parent has changed, ascending.
    moved: SmallVec<[NodeId; 4]>,
    labels: FxHashMap<NodeId, Label>,
    /// Whether every frame with a label is in `labels`.
    complete: bool,
}

impl<'s> Groups<'s> {
    /// Walks down from the changed edges, to at most `most` frames.
    pub(super) fn new(mut moved: SmallVec<[NodeId; 4]>, state: &'s State, most: usize) -> Self {
        moved.sort_unstable();
        moved.dedup();
        let mut below: SmallVec<[(NodeId, NodeId); 16]> = moved.iter().map(|&frame| (frame, frame)).collect();
        let (mut labels, mut complete) = (FxHashMap::default(), true);
        while let Some((frame, label)) = below.pop() {
            if labels.len() >= most {
                complete = false;
                break;
            }
            labels.insert(frame, Some(label));
            let children = state.children(frame).iter();
            // A child that has moved itself begins another group.
            below.extend(children.filter(|child| moved.binary_search(child).is_err()).map(|&c| (c, label)));
        }
        Self { state, moved, labels, complete }
    }

    /// The frames below changed edges; `None` if they were too many to walk.
    pub(super) fn moved(&self) -> Option<impl Iterator<Item = NodeId>> {
        self.complete.then(|| self.labels.keys().copied())
    }

    /// Whether the frame is known to be below a changed edge.
    pub(super) fn has_moved(&self, frame: NodeId) -> bool {
        self.labels.contains_key(&frame)
    }

    fn of(&mut self, frame: NodeId) -> Label {
        if self.complete {
            return self.labels.get(&frame).copied().flatten();
        }
        let (mut path, mut at) = (SmallVec::<[NodeId; 32]>::new(), frame);
        let label = loop {
            if let Some(label) = self.labels.get(&at) {
                break *label;
            }
            path.push(at);
            if self.moved.binary_search(&at).is_ok() {
                break Some(at);
            }
            match self.state.joint(at) {
                Some(joint) => at = joint.parent,
                None => break None,
            }
        };
        self.labels.extend(path.into_iter().map(|frame| (frame, label)));
        label
    }
}

/// The frames that may be at one end of a metric.
enum Domain<'e> {
    Constant(NodeId),
    Types(&'e [TypeId]),
}

impl Domain<'_> {
    fn count(&self, state: &State) -> usize {
        match self {
            Self::Constant(_) => 1,
            Self::Types(types) => types.iter().map(|&exact| state.count_exactly(exact)).sum(),
        }
    }

    fn each<'s>(&'s self, state: &'s State) -> impl Iterator<Item = NodeId> + 's {
        let (constant, types) = match self {
            Self::Constant(node) => (Some(*node), &[][..]),
            Self::Types(types) => (None, *types),
        };
        constant.into_iter().chain(types.iter().flat_map(|&exact| state.nodes_exactly(exact)))
    }

    fn has(&self, node: NodeId, state: &State) -> bool {
        match self {
            Self::Constant(constant) => *constant == node,
            Self::Types(types) => state.node(node).is_some_and(|node| types.contains(&node.node_type())),
        }
    }
}

impl Pattern {
    fn domain<'p>(&self, end: &'p End, state: &State) -> Domain<'p> {
        self.constant(end.slot, state).map_or(Domain::Types(&end.types), Domain::Constant)
    }

    /// Adds the slices that the moved frames may have changed: as many as the budget allows, or else all matches.
    /// Returns the groups, if anything has moved.
    pub(super) fn apart<'s>(
        &self,
        moved: SmallVec<[NodeId; 4]>,
        state: &'s State,
        budget: usize,
        into: &mut Slices,
    ) -> Option<Groups<'s>> {
        let frames = |ends: &[End; 2]| -> usize {
            ends.iter().map(|end| self.domain(end, state).count(state)).fold(0, usize::saturating_add)
        };
        let most = self.measured.iter().map(frames).max().unwrap_or(0);
        if moved.is_empty() || most == 0 {
            return None;
        }
        let mut groups = Groups::new(moved, state, most.min(budget));
        for ends in &self.measured {
            let Slices::These(slices) = into else { break };
            if self.across(ends, &mut groups, budget, slices) == Reach::All {
                *into = Slices::All;
            }
        }
        Some(groups)
    }

    /// Adds the slices for one metric.
    fn across(
        &self,
        ends: &[End; 2],
        groups: &mut Groups<'_>,
        budget: usize,
        slices: &mut SmallVec<[Fixed; 4]>,
    ) -> Reach {
        let state = groups.state;
        let domains = [0, 1].map(|side| self.domain(&ends[side], state));
        let totals = [0, 1].map(|side| domains[side].count(state));
        if totals.contains(&0) {
            return Reach::These;
        }
        let tally = if groups.complete {
            below(&domains, totals, groups)
        } else if totals[0].saturating_add(totals[1]) <= budget {
            above(&domains, groups)
        } else {
            return Reach::All;
        };
        // An end that is not a top-level variable cannot fix a slice.
        let speaks = [0, 1].map(|side| usize::from(ends[side].slot.0) < self.variables.len());
        let outside = |inside: &[usize; 2], side: usize| totals[side] - inside[side];
        let useful =
            |inside: &&[usize; 2]| [0, 1].iter().all(|&side| speaks[side] || outside(inside, side) == 0);
        let cost = |inside: &[usize; 2]| outside(inside, 0) + outside(inside, 1);
        // Leave out the group that makes the rest cheapest; among equals the frames that have not moved, which need no
        // search.
        let best = tally
            .iter()
            .filter(|(_, inside)| useful(inside))
            .map(|(label, inside)| (cost(inside), *label))
            .min_by_key(|(cost, label)| (*cost, *label));
        let Some((cost, left_out)) = best else { return Reach::All };
        let scanned = if left_out.is_some() { totals[0].saturating_add(totals[1]) } else { cost };
        if cost == 0 {
            return Reach::These;
        }
        if scanned > budget {
            return Reach::All;
        }
        // The group that is left out contains every frame of an end that cannot fix a slice.
        for (side, domain) in domains.iter().enumerate().filter(|(side, _)| speaks[*side]) {
            let at = usize::from(ends[side].slot.0);
            let mut begin = |node| slices.push(Fixed::from_slice(&[(at, node)]));
            if groups.complete && left_out.is_none() {
                groups.labels.keys().filter(|node| domain.has(**node, state)).for_each(|&node| begin(node));
            } else {
                domain.each(state).filter(|&node| groups.of(node) != left_out).for_each(&mut begin);
            }
        }
        Reach::These
    }
}

#[derive(PartialEq)]
enum Reach {
    These,
    All,
}

/// Counts the frames of each group, when all moved frames are known.
fn below(domains: &[Domain<'_>; 2], totals: [usize; 2], groups: &Groups<'_>) -> Tally {
    let mut tally = Tally::default();
    let mut rest = totals;
    for (frame, label) in &groups.labels {
        for (side, domain) in domains.iter().enumerate() {
            if domain.has(*frame, groups.state) {
                tally.entry(*label).or_default()[side] += 1;
                rest[side] -= 1;
            }
        }
    }
    tally.insert(None, rest);
    tally
}

/// Counts the frames of each group by looking up every frame that may be measured.
fn above(domains: &[Domain<'_>; 2], groups: &mut Groups<'_>) -> Tally {
    let mut tally = Tally::default();
    for (side, domain) in domains.iter().enumerate() {
        for frame in domain.each(groups.state) {
            tally.entry(groups.of(frame)).or_default()[side] += 1;
        }
    }
    tally
}
