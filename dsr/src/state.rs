//! One state of the graph, and the raw edits that keep its indexes in step.
//!
//! A state is the value behind a snapshot: nodes in copy-on-write pages, each node with its edges, attributes
//! and place in the tree of transforms. Raw edits check nothing (transactions do, in `transaction::apply`;
//! replay trusts its journal) but never leave half an edge: an edge is listed at both ends, a transform at
//! parent and child, a reference at what it refers to.
//!
//! Cost: a copy is a handful of reference counts. A raw edit on a copy clones the touched nodes and their page
//! paths once; lists inside a node are sorted vectors, found by binary search.

use std::sync::Arc;

use nalgebra::Isometry3;

use crate::dictionary::Dictionary;
use crate::id::{AgentId, AttributeId, EdgeKey, Holder, LabelId, NodeId, Time, TypeId, Version};
use crate::mentions::Mentions;
use crate::names::Names;
use crate::pages::Pages;
use crate::reflex::Registry;
use crate::value::Value;

#[derive(Debug, Clone)]
pub(crate) struct Cell {
    pub(crate) attribute: AttributeId,
    pub(crate) value: Value,
    pub(crate) since: Version,
}

#[derive(Debug, Clone)]
pub(crate) struct Edge {
    pub(crate) label: LabelId,
    pub(crate) to: NodeId,
    pub(crate) since: Version,
    pub(crate) attributes: Vec<Cell>,
}

/// The transform from a node to its parent in the geometric quiver.
#[derive(Debug, Clone)]
pub(crate) struct Joint {
    pub(crate) parent: NodeId,
    pub(crate) transform: Isometry3<f64>,
    pub(crate) since: Version,
}

#[derive(Debug, Clone)]
pub(crate) struct Node {
    pub(crate) name: Arc<str>,
    pub(crate) node_type: TypeId,
    pub(crate) since: Version,
    /// Sorted by attribute.
    pub(crate) attributes: Vec<Cell>,
    /// Sorted by label and end.
    pub(crate) outgoing: Vec<Edge>,
    /// Sorted.
    pub(crate) incoming: Vec<(LabelId, NodeId)>,
    pub(crate) joint: Option<Joint>,
    /// Sorted.
    pub(crate) children: Vec<NodeId>,
    /// Attributes elsewhere whose value is this node; sorted.
    pub(crate) referrers: Vec<(Holder, AttributeId)>,
}

impl Node {
    pub(crate) fn edge(&self, label: LabelId, to: NodeId) -> Option<&Edge> {
        self.outgoing
            .binary_search_by_key(&(label, to), |e| (e.label, e.to))
            .ok()
            .map(|at| &self.outgoing[at])
    }

    /// The edges with one label: a contiguous run of the sorted list.
    pub(crate) fn edges(&self, label: LabelId) -> &[Edge] {
        let start = self.outgoing.partition_point(|e| e.label < label);
        let end = self.outgoing.partition_point(|e| e.label <= label);
        &self.outgoing[start..end]
    }

    /// The starts of the edges with one label that end here.
    pub(crate) fn sources(&self, label: LabelId) -> &[(LabelId, NodeId)] {
        let start = self.incoming.partition_point(|(l, _)| *l < label);
        let end = self.incoming.partition_point(|(l, _)| *l <= label);
        &self.incoming[start..end]
    }

    /// Whether the node takes part in the geometric quiver as a root: children but no parent.
    pub(crate) fn is_root(&self) -> bool {
        self.joint.is_none() && !self.children.is_empty()
    }
}

/// What the transaction in progress has touched; empty in every published state.
#[derive(Debug, Clone, Default)]
pub(crate) struct Scratch {
    pub(crate) touched: Vec<NodeId>,
    pub(crate) mentions: Mentions,
}

#[derive(Debug, Clone)]
pub(crate) struct State {
    pub(crate) dictionary: Arc<Dictionary>,
    pub(crate) version: Version,
    pub(crate) time: Time,
    /// The id of the next new node.
    pub(crate) next: NodeId,
    pub(crate) nodes: Pages<Node>,
    pub(crate) names: Names,
    /// Per type, the nodes of exactly that type, ascending.
    by_type: Arc<Vec<Arc<Vec<NodeId>>>>,
    /// The root of the geometric quiver, if any node takes part in it.
    pub(crate) root: Option<NodeId>,
    pub(crate) reflexes: Registry,
    pub(crate) scratch: Scratch,
}

impl State {
    /// The state at version 0: the nodes that stand for agents and resources, nothing else.
    pub(crate) fn new(dictionary: Arc<Dictionary>) -> Self {
        let mut state = Self::empty(dictionary);
        let dictionary = Arc::clone(&state.dictionary);
        let agents = dictionary.agents().filter_map(|id| Some((dictionary.agent_name(id)?, TypeId::AGENT)));
        let resources =
            dictionary.resources().filter_map(|id| Some((dictionary.resource_name(id)?, TypeId::RESOURCE)));
        for (index, (name, node_type)) in agents.chain(resources).enumerate() {
            state.insert_node(NodeId::at(index), name.clone(), node_type, Version(0));
        }
        state.scratch = Scratch::default();
        state
    }

    pub(crate) fn empty(dictionary: Arc<Dictionary>) -> Self {
        let types = dictionary.types().count();
        Self {
            dictionary,
            version: Version(0),
            time: Time(0),
            next: NodeId(0),
            nodes: Pages::default(),
            names: Names::default(),
            by_type: Arc::new(vec![Arc::default(); types]),
            root: None,
            reflexes: Registry::default(),
            scratch: Scratch::default(),
        }
    }

    pub(crate) fn node(&self, id: NodeId) -> Option<&Node> {
        self.nodes.get(id.index()).map(|node| &**node)
    }

    fn node_mut(&mut self, id: NodeId) -> Option<&mut Node> {
        let node = self.nodes.get_mut(id.index())?;
        self.scratch.touched.push(id);
        Some(node)
    }

    /// A node for changes that are no change of content (the bookkeeping of versions).
    pub(crate) fn node_quietly(&mut self, id: NodeId) -> Option<&mut Node> {
        self.nodes.get_mut(id.index())
    }

    pub(crate) fn edge(&self, key: EdgeKey) -> Option<&Edge> {
        self.node(key.from)?.edge(key.label, key.to)
    }

    fn cells(&self, holder: Holder) -> Option<&Vec<Cell>> {
        match holder {
            Holder::Node(node) => self.node(node).map(|node| &node.attributes),
            Holder::Edge(key) => self.edge(key).map(|edge| &edge.attributes),
        }
    }

    pub(crate) fn cell(&self, holder: Holder, attribute: AttributeId) -> Option<&Cell> {
        let cells = self.cells(holder)?;
        cells.binary_search_by_key(&attribute, |cell| cell.attribute).ok().map(|at| &cells[at])
    }

    /// The nodes of exactly this type, ascending.
    pub(crate) fn nodes_exactly(&self, node_type: TypeId) -> &[NodeId] {
        self.by_type.get(node_type.index()).map_or(&[], |nodes| nodes.as_slice())
    }

    pub(crate) fn insert_node(&mut self, id: NodeId, name: Arc<str>, node_type: TypeId, since: Version) {
        let node = Node {
            name: name.clone(),
            node_type,
            since,
            attributes: Vec::new(),
            outgoing: Vec::new(),
            incoming: Vec::new(),
            joint: None,
            children: Vec::new(),
            referrers: Vec::new(),
        };
        self.nodes.set(id.index(), Some(node));
        self.names.insert(name, id);
        if let Some(nodes) = Arc::make_mut(&mut self.by_type).get_mut(node_type.index()) {
            insert_sorted(Arc::make_mut(nodes), id);
        }
        self.next = self.next.max(NodeId(id.0 + 1));
        self.scratch.touched.push(id);
        self.scratch.mentions.add_type(node_type);
    }

    /// Removes a node with all that touches it.
    pub(crate) fn remove_node(&mut self, id: NodeId) {
        let Some(node) = self.nodes.get(id.index()).cloned() else { return };
        for &(holder, attribute) in &node.referrers {
            self.remove_attribute(holder, attribute);
        }
        for edge in &node.outgoing {
            self.remove_edge(EdgeKey { from: id, label: edge.label, to: edge.to });
        }
        for &(label, from) in &node.incoming {
            self.remove_edge(EdgeKey { from, label, to: id });
        }
        for cell in &node.attributes {
            self.remove_attribute(Holder::Node(id), cell.attribute);
        }
        for &child in &node.children {
            self.remove_transform(child);
        }
        self.remove_transform(id);
        self.nodes.set(id.index(), None);
        self.names.remove(&node.name);
        if let Some(nodes) = Arc::make_mut(&mut self.by_type).get_mut(node.node_type.index()) {
            remove_sorted(Arc::make_mut(nodes), id);
        }
        self.scratch.touched.push(id);
        self.scratch.mentions.add_type(node.node_type);
    }

    /// Adds an edge between nodes that exist, unless it is there.
    pub(crate) fn insert_edge(&mut self, key: EdgeKey, since: Version) {
        let EdgeKey { from, label, to } = key;
        if self.edge(key).is_some() {
            return;
        }
        if let Some(node) = self.node_mut(from)
            && let Err(at) = node.outgoing.binary_search_by_key(&(label, to), |e| (e.label, e.to))
        {
            node.outgoing.insert(at, Edge { label, to, since, attributes: Vec::new() });
        }
        if let Some(node) = self.node_mut(to) {
            insert_sorted(&mut node.incoming, (label, from));
        }
        self.scratch.mentions.add_label(label);
    }

    /// Removes an edge with its attributes, if it is there.
    pub(crate) fn remove_edge(&mut self, key: EdgeKey) {
        let EdgeKey { from, label, to } = key;
        let Some(edge) = self.edge(key) else { return };
        for attribute in edge.attributes.iter().map(|cell| cell.attribute).collect::<Vec<_>>() {
            self.remove_attribute(Holder::Edge(key), attribute);
        }
        if let Some(node) = self.node_mut(from) {
            node.outgoing.retain(|edge| (edge.label, edge.to) != (label, to));
        }
        if let Some(node) = self.node_mut(to) {
            remove_sorted(&mut node.incoming, (label, from));
        }
        self.scratch.mentions.add_label(label);
    }

    /// Writes an attribute of a holder that exists, unless the value is the same.
    pub(crate) fn insert_attribute(
        &mut self,
        holder: Holder,
        attribute: AttributeId,
        value: Value,
        since: Version,
    ) {
        let old = self.cell(holder, attribute).map(|cell| cell.value.clone());
        if old.as_ref().is_some_and(|old| old.same(&value)) {
            return;
        }
        if let Some(Value::Node(target)) = old {
            self.forget(target, (holder, attribute));
        }
        if let Value::Node(target) = value
            && let Some(node) = self.node_mut(target)
        {
            insert_sorted(&mut node.referrers, (holder, attribute));
        }
        let cell = Cell { attribute, value, since };
        if let Some(cells) = self.cells_mut(holder) {
            match cells.binary_search_by_key(&attribute, |cell| cell.attribute) {
                Ok(at) => cells[at] = cell,
                Err(at) => cells.insert(at, cell),
            }
        }
        self.scratch.mentions.add_attribute(attribute);
    }

    /// Removes an attribute, if it is there.
    pub(crate) fn remove_attribute(&mut self, holder: Holder, attribute: AttributeId) {
        let Some(cell) = self.cell(holder, attribute) else { return };
        if let Value::Node(target) = cell.value {
            self.forget(target, (holder, attribute));
        }
        if let Some(cells) = self.cells_mut(holder) {
            cells.retain(|cell| cell.attribute != attribute);
        }
        self.scratch.mentions.add_attribute(attribute);
    }

    /// Hangs `child` below `parent`; the child must have no other parent.
    pub(crate) fn insert_transform(
        &mut self,
        parent: NodeId,
        child: NodeId,
        transform: Isometry3<f64>,
        since: Version,
    ) {
        let same = |joint: &Joint| joint.parent == parent && same_transform(&joint.transform, &transform);
        if self.node(child).and_then(|node| node.joint.as_ref()).is_some_and(same) {
            return;
        }
        if let Some(node) = self.node_mut(child) {
            node.joint = Some(Joint { parent, transform, since });
        }
        let listed = self.node(parent).is_some_and(|node| node.children.binary_search(&child).is_ok());
        if !listed && let Some(node) = self.node_mut(parent) {
            insert_sorted(&mut node.children, child);
        }
        self.scratch.mentions.add_transforms();
    }

    /// Takes `child` off its parent, if it has one.
    pub(crate) fn remove_transform(&mut self, child: NodeId) {
        let Some(parent) = self.node(child).and_then(|node| Some(node.joint.as_ref()?.parent)) else {
            return;
        };
        if let Some(node) = self.node_mut(child) {
            node.joint = None;
        }
        if let Some(node) = self.node_mut(parent) {
            remove_sorted(&mut node.children, child);
        }
        self.scratch.mentions.add_transforms();
    }

    fn cells_mut(&mut self, holder: Holder) -> Option<&mut Vec<Cell>> {
        match holder {
            Holder::Node(node) => self.node_mut(node).map(|node| &mut node.attributes),
            Holder::Edge(key) => {
                let node = self.node_mut(key.from)?;
                let at =
                    node.outgoing.binary_search_by_key(&(key.label, key.to), |e| (e.label, e.to)).ok()?;
                Some(&mut node.outgoing[at].attributes)
            }
        }
    }

    fn forget(&mut self, target: NodeId, referrer: (Holder, AttributeId)) {
        if let Some(node) = self.node_mut(target) {
            remove_sorted(&mut node.referrers, referrer);
        }
    }

    /// The name of a node, for errors and sentences; of an agent too, since its node never goes.
    pub(crate) fn name(&self, id: NodeId) -> Arc<str> {
        self.node(id).map_or_else(|| id.to_string().into(), |node| node.name.clone())
    }

    pub(crate) fn agent_name(&self, id: AgentId) -> Arc<str> {
        self.dictionary.agent_name(id).cloned().unwrap_or_else(|| id.to_string().into())
    }
}

/// Same to the bit.
pub(crate) fn same_transform(a: &Isometry3<f64>, b: &Isometry3<f64>) -> bool {
    let bits = |iso: &Isometry3<f64>| {
        let (t, q) = (&iso.translation.vector, &iso.rotation.coords);
        [t.x, t.y, t.z, q.x, q.y, q.z, q.w].map(f64::to_bits)
    };
    bits(a) == bits(b)
}

fn insert_sorted<T: Ord>(list: &mut Vec<T>, item: T) {
    if let Err(at) = list.binary_search(&item) {
        list.insert(at, item);
    }
}

fn remove_sorted<T: Ord + Copy>(list: &mut Vec<T>, item: T) {
    if let Ok(at) = list.binary_search(&item) {
        list.remove(at);
    }
}
