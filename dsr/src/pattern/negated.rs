//! Negated parts, judged by the frames that have moved.
//!
//! Problem: a single step of one person among a thousand can break "a robot with no person near", but judging that from
//! scratch looks at all persons. Idea: while a match is held, it is known that no person was near before. So only a
//! person who has moved can be near now, and only those are checked. For a binding that is not a match, remember one
//! person who was near (a witness): as long as that person is near, the others need no look.
//!
//! Invariant: the moved frames are enough if all of the following hold. A match is held with the same nodes for the
//! variables that the part has from outside. The deltas since then changed the part by moves alone. No frame that the
//! part measures from outside has moved. With hysteresis, a match may be held that would not appear, so it says nothing
//! about other bindings: then it must be the very match that is judged. Otherwise the whole part is searched. A witness
//! is checked again each time. Cost: one entry per binding that such a part excludes, as a held match costs one.

use std::cell::RefCell;

use rustc_hash::FxHashMap;
use smallvec::SmallVec;

use super::compiled::Pattern;
use super::fixed::Fixed;
use super::held::Held;
use super::part::Part;
use super::rigid::Groups;
use super::slot::Slot;
use crate::id::NodeId;
use crate::state::State;

/// A frame that has moved and can stand for one of a part's own variables: the position of the variable, and the frame.
type Suspect = (usize, NodeId);

/// The moved frames of each part of a pattern; `None` for a part that changed by more than moves.
#[derive(Default)]
pub(crate) struct Moves<'s> {
    parts: SmallVec<[Option<SmallVec<[Suspect; 4]>>; 2]>,
    groups: Option<Groups<'s>>,
    /// Lent by the subscriber for one update.
    pub(crate) witnesses: RefCell<Witnesses>,
}

impl<'s> Moves<'s> {
    /// The moves of a pattern; the parts in `touched` have changed by more than moves.
    pub(super) fn new(
        pattern: &Pattern,
        touched: &[usize],
        groups: Option<Groups<'s>>,
        state: &'s State,
    ) -> Self {
        let suspects = |part: &Part| {
            if touched.contains(&part.at) {
                return None;
            }
            let (mut found, mut most) = (SmallVec::new(), 0_usize);
            let Some(groups) = &groups else { return Some(found) };
            for (own, (end, _)) in part.own.iter().enumerate() {
                let fits =
                    |node: &NodeId| state.node(*node).is_some_and(|n| end.types.contains(&n.node_type()));
                found.extend(groups.moved()?.filter(fits).map(|node| (own, node)));
                most += end.types.iter().map(|&exact| state.count_exactly(exact)).sum::<usize>();
            }
            // Beyond this number, a search of the part looks at fewer frames.
            (found.len() < most || found.is_empty()).then_some(found)
        };
        Self { parts: pattern.parts.iter().map(suspects).collect(), groups, witnesses: RefCell::default() }
    }
}

/// A negated part, with nodes for its variables from outside.
pub(super) type Case = (usize, Fixed);

/// Nodes for a part's own variables.
pub(super) type Witness = SmallVec<[NodeId; 2]>;

/// The witnesses that the last search of each negated part found.
#[derive(Debug, Default)]
pub(crate) struct Witnesses(FxHashMap<Case, Witness>);

impl Witnesses {
    pub(super) fn get(&self, case: &Case) -> Option<Witness> {
        self.0.get(case).cloned()
    }

    pub(super) fn put(&mut self, case: Case, found: Option<Witness>) {
        match found {
            Some(witness) => _ = self.0.insert(case, witness),
            None => _ = self.0.remove(&case),
        }
    }

    pub(crate) fn len(&self) -> usize {
        self.0.len()
    }

    /// Drops the cases whose nodes have been removed.
    pub(crate) fn forget(&mut self, state: &State) {
        self.0.retain(|(_, outer), _| outer.iter().all(|(_, node)| state.node(*node).is_some()));
    }
}

/// What is known while matching.
pub(crate) struct Known<'a> {
    pub(crate) moves: &'a Moves<'a>,
    pub(crate) held: &'a Held,
}

/// How to judge a part.
pub(super) enum Judge<'a> {
    /// Check these frames only.
    Suspects(&'a Part, &'a [Suspect]),
    /// Search the part.
    Search(&'a Part, Case),
}

impl<'a> Known<'a> {
    /// How to judge a part of the pattern, if it is one of `Pattern::parts`; `node` returns the node in a slot.
    pub(super) fn judge(
        &'a self,
        pattern: &'a Pattern,
        at: usize,
        node: impl Fn(Slot) -> NodeId,
    ) -> Option<Judge<'a>> {
        let place = pattern.parts.iter().position(|part| part.at == at)?;
        let part = &pattern.parts[place];
        let outer: Fixed = part.outer.iter().map(|&at| (at, node(pattern.variable_slot(at)))).collect();
        let groups = self.moves.groups.as_ref();
        let moved =
            groups.is_some_and(|groups| part.anchors.iter().any(|slot| groups.has_moved(node(*slot))));
        Some(match &self.moves.parts[place] {
            Some(suspects) if !moved && self.held.with(&outer).next().is_some() => {
                Judge::Suspects(part, suspects)
            }
            _ => Judge::Search(part, (at, outer)),
        })
    }
}
