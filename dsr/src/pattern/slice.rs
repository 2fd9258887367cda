//! The matches that deltas may have changed, as slices: nodes for some of the variables.

use smallvec::SmallVec;

use super::compiled::{Constant, Pattern};
use super::fixed::{Fixed, Slices};
use super::negated::Moves;
use super::rigid::moved;
use super::seed::Seed;
use super::slot::Slot;
use crate::delta::{Change, Delta};
use crate::id::{Holder, NodeId};
use crate::state::State;

impl Pattern {
    /// Whether deltas may have changed any match. Most commits concern few patterns, and this is the cheapest answer.
    pub(crate) fn concerned_by<'d>(&self, deltas: impl IntoIterator<Item = &'d Delta>) -> bool {
        !self.measured.is_empty()
            || deltas.into_iter().flat_map(|delta| &delta.changes).any(|change| {
                self.concerns_constant(change) || self.seeds.iter().any(|s| may_grow(s.seed, change))
            })
    }

    /// The matches that deltas may have changed; and, for negated parts that can be judged by it, what has moved in
    /// them. `state` is the state after the last delta. Cost: linear in the length of the deltas, plus at most
    /// `budget`.
    pub(crate) fn slices<'d, 's>(
        &self,
        deltas: impl IntoIterator<Item = &'d Delta>,
        state: &'s State,
        budget: usize,
    ) -> (Slices, Option<Moves<'s>>) {
        let (mut slices, mut frames) = (SmallVec::<[Fixed; 4]>::new(), SmallVec::new());
        let mut touched = SmallVec::<[usize; 4]>::new();
        for change in deltas.into_iter().flat_map(|delta| &delta.changes) {
            if self.concerns_constant(change) {
                return (Slices::All, None);
            }
            for seedling in &self.seeds {
                if let Growth::Slice(fixed) = self.grow(seedling.seed, change, state) {
                    slices.push(fixed);
                    touched.extend(seedling.part);
                }
            }
            if !self.measured.is_empty() {
                frames.extend(moved(change, state));
            }
        }
        slices.sort_unstable();
        slices.dedup();
        // A slice that fixes no node is sorted first.
        let all = slices.first().is_some_and(SmallVec::is_empty);
        let mut found = if all { Slices::All } else { Slices::These(slices) };
        if all && self.parts.is_empty() {
            return (found, None);
        }
        let groups = self.apart(frames, state, budget, &mut found);
        if let Slices::These(slices) = &mut found {
            slices.sort_unstable();
            slices.dedup();
        }
        let moves = (!self.parts.is_empty()).then(|| Moves::new(self, &touched, groups, state));
        (found, moves)
    }

    /// Whether the change adds or removes a node that is a constant of the pattern.
    fn concerns_constant(&self, change: &Change) -> bool {
        let (Change::NodeAdded { node, name, .. } | Change::NodeRemoved { node, name, .. }) = change else {
            return false;
        };
        self.constants.iter().any(|constant| match constant {
            Constant::Node(id) => id == node,
            Constant::Named(found) => found == name,
        })
    }

    fn grow(&self, seed: Seed, change: &Change, state: &State) -> Growth {
        match (seed, change) {
            (Seed::Edge { label, from, to }, Change::EdgeAdded { edge } | Change::EdgeRemoved { edge })
                if edge.label == label =>
            {
                self.fix(&[(from, edge.from), (to, edge.to)], state)
            }
            (
                _,
                Change::AttributeAdded { holder, attribute: changed, .. }
                | Change::AttributeChanged { holder, attribute: changed, .. }
                | Change::AttributeRemoved { holder, attribute: changed, .. },
            ) => match (seed, holder) {
                (Seed::NodeAttribute { attribute, node }, Holder::Node(id)) if attribute == *changed => {
                    self.fix(&[(node, *id)], state)
                }
                (Seed::EdgeAttribute { attribute, label, from, to }, Holder::Edge(key))
                    if attribute == *changed && label == key.label =>
                {
                    self.fix(&[(from, key.from), (to, key.to)], state)
                }
                _ => Growth::Nothing,
            },
            (
                Seed::Loose(slot),
                Change::NodeAdded { node, node_type, .. } | Change::NodeRemoved { node, node_type, .. },
            ) if self.type_of(slot).is_some_and(|wanted| state.vocabulary.is_a(*node_type, wanted)) => {
                self.fix(&[(slot, *node)], state)
            }
            _ => Growth::Nothing,
        }
    }

    /// The slice that fixes these slots, unless one of them is a constant with another node.
    fn fix(&self, ends: &[(Slot, NodeId)], state: &State) -> Growth {
        let mut fixed = Fixed::new();
        for &(slot, node) in ends {
            let at = usize::from(slot.0);
            if self.constant(slot, state).is_some_and(|constant| constant != node) {
                return Growth::Nothing;
            }
            if at < self.variables.len() {
                fixed.push((at, node));
            }
        }
        Growth::Slice(fixed)
    }
}

/// Whether a seed may grow in a change, whatever the nodes.
fn may_grow(seed: Seed, change: &Change) -> bool {
    match change {
        Change::EdgeAdded { edge } | Change::EdgeRemoved { edge } => {
            matches!(seed, Seed::Edge { label, .. } if label == edge.label)
        }
        Change::AttributeAdded { attribute: changed, .. }
        | Change::AttributeChanged { attribute: changed, .. }
        | Change::AttributeRemoved { attribute: changed, .. } => match seed {
            Seed::NodeAttribute { attribute, .. } | Seed::EdgeAttribute { attribute, .. } => {
                attribute == *changed
            }
            _ => false,
        },
        Change::NodeAdded { .. } => matches!(seed, Seed::Loose(_)),
        // What a negated part knows of the node is forgotten.
        Change::NodeRemoved { .. } => true,
        Change::TransformAdded { .. }
        | Change::TransformChanged { .. }
        | Change::TransformSampled { .. }
        | Change::TransformRemoved { .. } => false,
    }
}

enum Growth {
    Nothing,
    Slice(Fixed),
}
