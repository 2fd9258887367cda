//! From a change to the matches that it may concern: where a join begins at the changed edge.
//!
//! Problem: matching a pattern again for each commit costs what the graph is large; the commit changed an edge. Idea:
//! a match can only come or go if one of its atoms, at the nodes of the match, changed. So each atom is a seed: the
//! change gives nodes to the variables of that atom, and only matches that have them there are looked at again. An
//! atom of a negated part gives nodes to those of its variables that the pattern has outside.
//!
//! Invariant: matches outside the slices of a delta are the same before and after it. Where a change gives no
//! variable a node (a constant comes or goes, a negated part shares no variable with the atom), all matches are
//! looked at again. Which frames a metric begins at is a matter of its own (`rigid`). A variable that an edge or an attribute binds needs no seed of its
//! own for nodes that come and go, because their edges and attributes come and go with them.
//!
//! Source: the semi-naive evaluation of Datalog (Bancilhon and Ramakrishnan, SIGMOD 1986), with single changes as
//! the deltas.

use smallvec::SmallVec;

use super::clue::{self, Clue, Ordered, ValueKey};
use super::negated::Moves;
use super::plan::Mask;
use super::rigid::moved;
use super::{Atom, Carrier, Comparison, Conjunction, Constant, Limit, Pattern, Right, Slot};
use crate::delta::{Change, Delta};
use crate::id::{AttributeId, Holder, LabelId, NodeId, TypeId};
use crate::state::State;

/// An atom as the beginning of a join.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Seed {
    Edge {
        label: LabelId,
        from: Slot,
        to: Slot,
    },
    NodeAttribute {
        attribute: AttributeId,
        node: Slot,
    },
    EdgeAttribute {
        attribute: AttributeId,
        label: LabelId,
        from: Slot,
        to: Slot,
    },
    /// A variable that nothing but its type binds.
    Loose(Slot),
}

/// An atom as a seed, and where in the pattern it is.
#[derive(Debug, Clone)]
pub(super) struct Seedling {
    seed: Seed,
    clue: Clue,
    /// The negated part of the pattern in which it is, if it is in one.
    part: Option<usize>,
}

/// The seeds of a pattern.
pub(super) fn seedlings(body: &Conjunction<Slot>) -> Vec<Seedling> {
    let mut found = Vec::new();
    seeds(&[body], None, &mut found);
    found
}

/// The seeds of the last of these conjunctions, which stand within each other, and of the negated parts in it.
fn seeds(around: &[&Conjunction<Slot>], inside: Option<usize>, all: &mut Vec<Seedling>) {
    let mut found = Vec::new();
    let into = &mut found;
    let Some(part) = around.last() else { return };
    let mut bound = Mask::default();
    for (at, atom) in part.atoms.iter().enumerate() {
        match atom {
            Atom::Edge { from, label, to } => {
                let seed = Seed::Edge { label: *label, from: *from, to: *to };
                into.push((seed, clue::of_edge((*from, *to), at, around)));
                bound.insert(*from);
                bound.insert(*to);
            }
            Atom::Present { holder, attribute } => {
                carrier(holder, *attribute, Clue::Any, &mut bound, into);
            }
            Atom::Guard { holder, attribute, comparison, operand } => {
                let clue = clue::of_guard(*comparison, operand);
                carrier(holder, *attribute, clue, &mut bound, into);
                match operand {
                    Right::Attribute(holder, attribute) => {
                        carrier(holder, *attribute, Clue::Any, &mut bound, into);
                    }
                    Right::Term(slot) if *comparison == Comparison::Equal => bound.insert(*slot),
                    Right::Term(_) | Right::Value(_) => {}
                }
            }
            Atom::Metric { from, limit, .. } => {
                if let Limit::Attribute(attribute) = limit {
                    into.push((Seed::NodeAttribute { attribute: *attribute, node: *from }, Clue::Any));
                }
            }
            Atom::Without(inner) => seeds(&[around, &[inner]].concat(), inside.or(Some(at)), all),
            // A node is of its type from when it comes to when it goes, which is what `Loose` is for.
            Atom::Distinct(..) | Atom::IsA(..) => {}
        }
    }
    let loose = part.variables.iter().filter(|slot| !bound.contains(**slot));
    into.extend(loose.map(|slot| (Seed::Loose(*slot), Clue::Any)));
    all.extend(found.into_iter().map(|(seed, clue)| Seedling { seed, clue, part: inside }));
}

fn carrier(
    holder: &Carrier<Slot>,
    attribute: AttributeId,
    clue: Clue,
    bound: &mut Mask,
    into: &mut Vec<(Seed, Clue)>,
) {
    match *holder {
        Carrier::Node(node) => {
            into.push((Seed::NodeAttribute { attribute, node }, clue));
            bound.insert(node);
        }
        Carrier::Edge { from, label, to } => {
            into.push((Seed::EdgeAttribute { attribute, label, from, to }, clue));
            bound.insert(from);
            bound.insert(to);
        }
    }
}

/// Nodes for some of the variables.
pub(crate) type Fixed = SmallVec<[(usize, NodeId); 2]>;

/// The matches that a delta may concern.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Slices {
    All,
    These(SmallVec<[Fixed; 4]>),
}

/// What a change must touch to concern a pattern.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub(crate) enum Route {
    /// An edge between nodes of these types, where the clue holds.
    Edge(LabelId, TypeId, TypeId, Clue),
    LabelFrom(LabelId, NodeId),
    LabelTo(LabelId, NodeId),
    Attribute(AttributeId),
    AttributeAt(AttributeId, NodeId),
    /// The attribute has, or had, this value.
    AttributeIs(AttributeId, ValueKey),
    /// The attribute crosses the number, and what is above matters, or what is below.
    Above(AttributeId, Ordered),
    Below(AttributeId, Ordered),
    Type(TypeId),
    /// The coming and going of a node.
    Node(NodeId),
    /// Where a frame of exactly this type is, or that frame.
    MovedType(TypeId),
    Moved(NodeId),
    /// Where any frame is.
    Transforms,
}

impl Pattern {
    /// What stands for a slot in a state, if it is a constant.
    pub(super) fn constant(&self, slot: Slot, state: &State) -> Option<NodeId> {
        let at = usize::from(slot.0).checked_sub(self.variables.len() + self.locals.len())?;
        self.constants.get(at).map(|constant| match constant {
            Constant::Node(id) => *id,
            Constant::Named(name) => state.names.get(name).unwrap_or(NodeId::NOWHERE),
        })
    }

    /// The names of nodes that the pattern speaks of.
    pub(crate) fn names(&self) -> impl Iterator<Item = &std::sync::Arc<str>> {
        self.constants.iter().filter_map(|constant| match constant {
            Constant::Named(name) => Some(name),
            Constant::Node(_) => None,
        })
    }

    /// The routes by which changes reach the pattern, with the constants of this state.
    pub(crate) fn routes(&self, state: &State) -> Vec<Route> {
        let mut routes = Vec::new();
        let attribute_of = |attribute, clue| match clue {
            Clue::Is(key) => Route::AttributeIs(attribute, key),
            Clue::Above(number) => Route::Above(attribute, number),
            Clue::Below(number) => Route::Below(attribute, number),
            Clue::Any | Clue::With(..) | Clue::Beside(..) => Route::Attribute(attribute),
        };
        for &Seedling { seed, clue, .. } in &self.seeds {
            match seed {
                Seed::Edge { label, from, to } => {
                    let wanted = |slot| self.type_of(slot).unwrap_or(TypeId::OBJECT);
                    routes.push(match (self.constant(from, state), self.constant(to, state)) {
                        (Some(from), _) => Route::LabelFrom(label, from),
                        (None, Some(to)) => Route::LabelTo(label, to),
                        (None, None) => Route::Edge(label, wanted(from), wanted(to), clue),
                    });
                }
                Seed::NodeAttribute { attribute, node } => routes.push(match self.constant(node, state) {
                    Some(node) => Route::AttributeAt(attribute, node),
                    None => attribute_of(attribute, clue),
                }),
                Seed::EdgeAttribute { attribute, from, to, .. } => {
                    routes.push(match self.constant(from, state).or(self.constant(to, state)) {
                        Some(end) => Route::AttributeAt(attribute, end),
                        None => attribute_of(attribute, clue),
                    });
                }
                Seed::Loose(slot) => {
                    let wanted = self.type_of(slot);
                    let subtypes = state
                        .vocabulary
                        .types()
                        .filter(|&sub| wanted.is_some_and(|wanted| state.vocabulary.is_a(sub, wanted)));
                    routes.extend(subtypes.map(Route::Type));
                }
            }
        }
        for end in self.measured.iter().flatten() {
            match self.constant(end.slot, state) {
                Some(frame) => routes.push(Route::Moved(frame)),
                None => routes.extend(end.types.iter().map(|exact| Route::MovedType(*exact))),
            }
        }
        if !self.measured.is_empty() {
            routes.push(Route::Transforms);
        }
        routes.extend(self.constants.iter().filter_map(|constant| match constant {
            Constant::Node(id) => Some(Route::Node(*id)),
            Constant::Named(_) => None,
        }));
        routes
    }

    /// The matches that deltas may concern, and what has moved in negated parts, if that is enough to judge them by; the
    /// state is the one after the last of them. Finding them costs no more than the budget beside what the deltas are long.
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
        // One without any node comes first.
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

    /// Whether a node that the pattern speaks of comes or goes.
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

    /// Gives the nodes to the variables of the pattern, unless a constant is another node.
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

enum Growth {
    Nothing,
    Slice(Fixed),
}
