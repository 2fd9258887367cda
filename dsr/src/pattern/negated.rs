//! What is negated, judged by what has moved in it.
//!
//! Problem: "a robot with nobody near" is lost by one person of a thousand who takes a step, but to judge it is to look
//! for somebody near among all of them. Idea: while a match is held, it is known that nobody was. So only somebody who
//! has moved can be near now, and to look at those is enough. Of what was searched and is no match, somebody who was
//! near is remembered: as long as they are, nobody else has to be looked for.
//!
//! Invariant: it is enough where a match with the same nodes for the variables that the part has from outside is held,
//! the deltas since have touched the part by moves alone, and nothing has moved that it measures from outside. With two
//! numbers a match may be held that would not appear, so that says nothing about others: then the match must be the
//! very one. Otherwise the whole part is searched. Who is remembered is judged again each time. Cost: an entry per
//! binding that such a part keeps from being a match, as what is held costs one per match.

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

/// A frame that has moved, as one of a part's own variables, by its place among them.
type Suspect = (usize, NodeId);

/// What has moved in each part of a pattern; nothing where more than moves has touched it.
#[derive(Default)]
pub(crate) struct Moves<'s> {
    parts: SmallVec<[Option<SmallVec<[Suspect; 4]>>; 2]>,
    groups: Option<Groups<'s>>,
    /// Lent for one look.
    pub(crate) witnesses: RefCell<Witnesses>,
}

impl<'s> Moves<'s> {
    /// Of a pattern of which these parts have been touched by other changes.
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
            // To search the part is to look at no more than these.
            (found.len() < most || found.is_empty()).then_some(found)
        };
        Self { parts: pattern.parts.iter().map(suspects).collect(), groups, witnesses: RefCell::default() }
    }
}

/// A negated part with nodes for what it has from outside.
pub(super) type Case = (usize, Fixed);

/// Nodes for a part's own variables.
pub(super) type Witness = SmallVec<[NodeId; 2]>;

/// Who was found in negated parts when they were searched last.
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

    /// Lets go of cases of nodes that are no longer there.
    pub(crate) fn forget(&mut self, state: &State) {
        self.0.retain(|(_, outer), _| outer.iter().all(|(_, node)| state.node(*node).is_some()));
    }
}

/// What is known while matches are looked for.
pub(crate) struct Known<'a> {
    pub(crate) moves: &'a Moves<'a>,
    pub(crate) held: &'a Held,
}

/// How a part is to be judged.
pub(super) enum Judge<'a> {
    /// It is enough to look at these.
    Suspects(&'a Part, &'a [Suspect]),
    /// By a search.
    Search(&'a Part, Case),
}

impl<'a> Known<'a> {
    /// How to judge a part of the pattern, if anything is known of it; `node` is what stands in a slot.
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
