//! The index of routes: from a change to the subscribers that are listed under it.
//!
//! Routes with a constant node are keys of one table. Edges without one are sorted by label, then by the types that the
//! pattern requires at both ends, then by clue; attributes are sorted by the value or number with which they are
//! compared. Which pairs of required types a pair of exact types satisfies is computed once and kept. Cost of a change:
//! one look-up per attribute and per label at the nodes that it touches, and only if some pattern mentions them.

use std::collections::BTreeMap;

use rustc_hash::FxHashMap;
use smallvec::SmallVec;

use crate::block::Node;
use crate::delta::{Change, Delta};
use crate::id::{AttributeId, EdgeKey, Holder, LabelId, NodeId, TypeId};
use crate::pattern::{Clue, Ordered, Route, Tip, ValueKey, Way, moved};
use crate::state::State;
use crate::value::Value;
use crate::vocabulary::Vocabulary;

/// A position in the list of subscribers.
pub(super) type Seat = usize;

pub(super) type Seats = SmallVec<[Seat; 2]>;

/// The number of frames that a commit walks for each subscriber that it may so avoid to wake: as many as take the time
/// of waking a parked thread. Measured at a load of 8: a commit that wakes one subscriber takes 5.8 µs, one that wakes
/// none 1.3 µs, and walking a thousand frames 7.6 µs.
const FRAMES: usize = 512;

/// The removals of a delta, by node: collected once, however many edges it changes.
pub(super) struct Gone {
    edges: Vec<(NodeId, LabelId, Way)>,
    nodes: Vec<(NodeId, TypeId)>,
}

impl Gone {
    pub(super) fn of(delta: &Delta) -> Self {
        let edges = delta.changes.iter().filter_map(|change| match change {
            Change::EdgeRemoved { edge } => Some(edge),
            _ => None,
        });
        let ends = |edge: &EdgeKey| [(edge.from, edge.label, Way::Out), (edge.to, edge.label, Way::In)];
        let mut ends: Vec<_> = edges.flat_map(ends).collect();
        ends.sort_unstable_by_key(|(node, ..)| *node);
        let nodes = delta.changes.iter().filter_map(|change| match change {
            Change::NodeRemoved { node, node_type, .. } => Some((*node, *node_type)),
            _ => None,
        });
        // A delta lists them in order.
        Self { edges: ends, nodes: nodes.collect() }
    }

    /// The type of a removed node.
    fn type_of(&self, node: NodeId) -> Option<TypeId> {
        let at = self.nodes.binary_search_by_key(&node, |(other, _)| *other).ok()?;
        Some(self.nodes[at].1)
    }

    fn at(&self, node: NodeId) -> impl Iterator<Item = (LabelId, Way)> + '_ {
        let start = self.edges.partition_point(|(other, ..)| *other < node);
        self.edges[start..]
            .iter()
            .take_while(move |(other, ..)| *other == node)
            .map(|(_, label, way)| (*label, *way))
    }
}

/// The types of the two ends of an edge.
type Ends = (TypeId, TypeId);

/// The seats of all routes.
#[derive(Default)]
pub(super) struct Index {
    plain: FxHashMap<Route, Seats>,
    labels: FxHashMap<LabelId, Fan>,
    thresholds: FxHashMap<AttributeId, Thresholds>,
}

/// The routes of edges with one label and variables at both ends.
#[derive(Default)]
struct Fan {
    /// By the types that the patterns require at the ends.
    classes: FxHashMap<Ends, Class>,
    /// For nodes of exactly these types, the classes whose types they satisfy.
    fitting: FxHashMap<Ends, SmallVec<[Ends; 2]>>,
}

#[derive(Default)]
struct Class {
    any: Seats,
    with: FxHashMap<(Tip, AttributeId, ValueKey), Seats>,
    beside: FxHashMap<(Tip, LabelId, Way), Seats>,
}

#[derive(Default)]
struct Thresholds {
    above: BTreeMap<Ordered, Seats>,
    below: BTreeMap<Ordered, Seats>,
}

impl Class {
    fn list(&mut self, clue: Clue) -> &mut Seats {
        match clue {
            Clue::With(tip, attribute, key) => self.with.entry((tip, attribute, key)).or_default(),
            Clue::Beside(tip, label, way) => self.beside.entry((tip, label, way)).or_default(),
            Clue::Any | Clue::Is(_) | Clue::Above(_) | Clue::Below(_) => &mut self.any,
        }
    }

    fn is_empty(&self) -> bool {
        self.any.is_empty() && self.with.is_empty() && self.beside.is_empty()
    }
}

impl Index {
    fn list(&mut self, route: Route) -> &mut Seats {
        match route {
            Route::Edge(label, from, to, clue) => {
                let fan = self.labels.entry(label).or_default();
                fan.fitting.clear();
                fan.classes.entry((from, to)).or_default().list(clue)
            }
            Route::Above(attribute, number) => {
                self.thresholds.entry(attribute).or_default().above.entry(number).or_default()
            }
            Route::Below(attribute, number) => {
                self.thresholds.entry(attribute).or_default().below.entry(number).or_default()
            }
            plain => self.plain.entry(plain).or_default(),
        }
    }

    pub(super) fn add(&mut self, route: Route, seat: Seat) {
        let list = self.list(route);
        if !list.contains(&seat) {
            list.push(seat);
        }
    }

    pub(super) fn remove(&mut self, route: Route, seat: Seat) {
        let list = self.list(route);
        list.retain(|other| *other != seat);
        if !list.is_empty() {
            return;
        }
        // Entries without a subscriber are removed.
        match route {
            Route::Edge(label, from, to, clue) => {
                let Some(fan) = self.labels.get_mut(&label) else { return };
                let Some(class) = fan.classes.get_mut(&(from, to)) else { return };
                match clue {
                    Clue::With(tip, attribute, key) => _ = class.with.remove(&(tip, attribute, key)),
                    Clue::Beside(tip, label, way) => _ = class.beside.remove(&(tip, label, way)),
                    Clue::Any | Clue::Is(_) | Clue::Above(_) | Clue::Below(_) => {}
                }
                if class.is_empty() {
                    fan.classes.remove(&(from, to));
                }
                if fan.classes.is_empty() {
                    self.labels.remove(&label);
                }
            }
            Route::Above(attribute, number) | Route::Below(attribute, number) => {
                let Some(thresholds) = self.thresholds.get_mut(&attribute) else { return };
                if matches!(route, Route::Above(..)) {
                    thresholds.above.remove(&number);
                } else {
                    thresholds.below.remove(&number);
                }
                if thresholds.above.is_empty() && thresholds.below.is_empty() {
                    self.thresholds.remove(&attribute);
                }
            }
            plain => _ = self.plain.remove(&plain),
        }
    }

    /// Calls `tell` with the seats that a change of a delta may concern; some may come more than once. `state` is the
    /// state after the delta. For moves see [`Index::find_moved`].
    pub(super) fn find(
        &mut self,
        change: &Change,
        gone: &Gone,
        state: &State,
        mut tell: impl FnMut(&[Seat]),
    ) {
        match change {
            Change::EdgeAdded { edge } | Change::EdgeRemoved { edge } => {
                self.plain(Route::LabelFrom(edge.label, edge.from), &mut tell);
                self.plain(Route::LabelTo(edge.label, edge.to), &mut tell);
                if let Some(fan) = self.labels.get_mut(&edge.label) {
                    fan.find(*edge, gone, state, &mut tell);
                }
            }
            Change::AttributeAdded { holder, attribute, new } => {
                self.attribute(*holder, *attribute, (None, Some(new)), &mut tell);
            }
            Change::AttributeChanged { holder, attribute, old, new } => {
                self.attribute(*holder, *attribute, (Some(old), Some(new)), &mut tell);
            }
            Change::AttributeRemoved { holder, attribute, old } => {
                self.attribute(*holder, *attribute, (Some(old), None), &mut tell);
            }
            Change::NodeAdded { node, node_type, .. } | Change::NodeRemoved { node, node_type, .. } => {
                self.plain(Route::Type(*node_type), &mut tell);
                self.plain(Route::Node(*node), &mut tell);
            }
            Change::TransformAdded { .. }
            | Change::TransformChanged { .. }
            | Change::TransformSampled { .. }
            | Change::TransformRemoved { .. } => {}
        }
    }

    /// Calls `tell` with the seats that the moves of a delta may concern: those of patterns that measure a frame below
    /// a changed edge, because a metric that changes has an end there. If more frames are below than are worth walking,
    /// with the seats of all patterns that measure.
    pub(super) fn find_moved(&self, delta: &Delta, state: &State, mut tell: impl FnMut(&[Seat])) {
        if let Some(any) = self.plain.get(&Route::AnyTransform)
            && delta.changes.iter().any(is_transform)
        {
            tell(any);
        }
        let Some(all) = self.plain.get(&Route::Transforms) else { return };
        let mut frames: SmallVec<[NodeId; 16]> =
            delta.changes.iter().filter_map(|change| moved(change, state)).collect();
        frames.sort_unstable();
        frames.dedup();
        let mut told = SmallVec::<[TypeId; 8]>::new();
        let mut left = all.len() * FRAMES;
        let mut below = frames.clone();
        while let Some(frame) = below.pop() {
            let Some(rest) = left.checked_sub(1) else { return tell(all) };
            left = rest;
            self.plain(Route::Moved(frame), &mut tell);
            if let Some(exact) = state.node(frame).map(Node::node_type)
                && !told.contains(&exact)
            {
                told.push(exact);
                self.plain(Route::MovedType(exact), &mut tell);
            }
            let children = state.children(frame).iter().copied();
            below.extend(children.filter(|child| frames.binary_search(child).is_err()));
        }
    }

    fn plain(&self, route: Route, tell: &mut impl FnMut(&[Seat])) {
        if let Some(seats) = self.plain.get(&route) {
            tell(seats);
        }
    }

    fn attribute(
        &self,
        holder: Holder,
        attribute: AttributeId,
        (old, new): (Option<&Value>, Option<&Value>),
        tell: &mut impl FnMut(&[Seat]),
    ) {
        self.plain(Route::Attribute(attribute), tell);
        match holder {
            Holder::Node(node) => self.plain(Route::AttributeAt(attribute, node), tell),
            Holder::Edge(key) => {
                self.plain(Route::AttributeAt(attribute, key.from), tell);
                self.plain(Route::AttributeAt(attribute, key.to), tell);
            }
        }
        for value in [old, new].into_iter().flatten() {
            self.plain(Route::AttributeIs(attribute, ValueKey::of(value)), tell);
        }
        let Some(thresholds) = self.thresholds.get(&attribute) else { return };
        let number = |value: Option<&Value>| value.and_then(Value::as_number).map(Ordered::of);
        let (old, new) = (number(old), number(new));
        // An absent attribute is on neither side of a threshold: it counts as beyond the largest or smallest number.
        let crossed = |absent: Ordered| {
            let (old, new) = (old.unwrap_or(absent), new.unwrap_or(absent));
            old.min(new)..=old.max(new)
        };
        thresholds.above.range(crossed(Ordered::LEAST)).for_each(|(_, seats)| tell(seats));
        thresholds.below.range(crossed(Ordered::MOST)).for_each(|(_, seats)| tell(seats));
    }
}

impl Fan {
    fn find(&mut self, edge: EdgeKey, gone: &Gone, state: &State, tell: &mut impl FnMut(&[Seat])) {
        let (from, to) = (state.node(edge.from), state.node(edge.to));
        // An end that no longer exists was removed in the same commit.
        let exact = |id, node: Option<Node<'_>>| node.map(Node::node_type).or_else(|| gone.type_of(id));
        let Some(exact) = exact(edge.from, from).zip(exact(edge.to, to)) else { return };
        let fitting = self.fitting.entry(exact).or_insert_with(|| {
            let fits = |wanted: &&Ends| fit(&state.vocabulary, exact, **wanted);
            self.classes.keys().filter(fits).copied().collect()
        });
        for wanted in fitting.iter() {
            let Some(class) = self.classes.get(wanted) else { continue };
            tell(&class.any);
            let (Some(from), Some(to)) = (from, to) else {
                // What a removed node had beside the edge is no longer known, so every clue passes.
                class.with.values().chain(class.beside.values()).for_each(|seats| tell(seats));
                continue;
            };
            for (tip, id, node) in [(Tip::From, edge.from, from), (Tip::To, edge.to, to)] {
                if !class.with.is_empty() {
                    for cell in node.cells() {
                        let key = (tip, cell.attribute, ValueKey::of(&cell.value));
                        class.with.get(&key).into_iter().for_each(|seats| tell(seats));
                    }
                }
                if !class.beside.is_empty() {
                    let mut look = |label, way| {
                        class.beside.get(&(tip, label, way)).into_iter().for_each(|seats| tell(seats));
                    };
                    let mut out = node.outgoing();
                    while let Some(first) = out.first() {
                        look(first.label, Way::Out);
                        out = &out[out.partition_point(|edge| edge.label == first.label)..];
                    }
                    let mut incoming = node.incoming();
                    while let Some((label, _)) = incoming.first() {
                        look(*label, Way::In);
                        incoming = &incoming[incoming.partition_point(|(other, _)| other == label)..];
                    }
                    // An edge that the same delta removed counts as present.
                    gone.at(id).for_each(|(label, way)| look(label, way));
                }
            }
        }
    }
}

fn is_transform(change: &Change) -> bool {
    matches!(
        change,
        Change::TransformAdded { .. }
            | Change::TransformChanged { .. }
            | Change::TransformSampled { .. }
            | Change::TransformRemoved { .. }
    )
}

fn fit(vocabulary: &Vocabulary, exact: Ends, wanted: Ends) -> bool {
    vocabulary.is_a(exact.0, wanted.0) && vocabulary.is_a(exact.1, wanted.1)
}
