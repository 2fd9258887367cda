//! One state of the graph, and the raw edits that keep its indexes in step.
//!
//! A state is the value behind a snapshot: nodes sixteen to a block, blocks in pages that are copied only while a
//! snapshot holds them, names and poses in pages of their own. Raw edits check nothing (transactions do, in
//! `transaction::apply`; replay trusts its journal) but never leave half an edge: an edge is listed at both ends,
//! a transform at parent and child, a reference at what it refers to. Each writes down what it overwrites (`undo`).
//!
//! Cost: a copy is a handful of reference counts. A raw edit is a binary search in one or two blocks; if somebody
//! holds them, each is copied once.

use std::sync::Arc;

use crate::block::{Block, Cell, Edge, EdgeCell, Frames, Joint, NODES, Node, place};
use crate::id::{AgentId, AttributeId, EdgeKey, Holder, NodeId, Time, TypeId, Version};
use crate::members::Members;
use crate::names::Names;
use crate::pages::Pages;
use crate::pose::Pose;
use crate::reflex::Registry;
use crate::track::Track;
use crate::undo::{Log, Undo};
use crate::value::Value;
use crate::vocabulary::Vocabulary;

#[derive(Debug, Clone)]
pub(crate) struct State {
    pub(crate) vocabulary: Arc<Vocabulary>,
    pub(crate) version: Version,
    pub(crate) time: Time,
    /// The id of the next new node.
    pub(crate) next: NodeId,
    blocks: Pages<Block>,
    frames: Pages<Frames>,
    pub(crate) names: Names,
    members: Members,
    /// The root of the geometric quiver, if any node takes part in it.
    pub(crate) root: Option<NodeId>,
    pub(crate) reflexes: Registry,
    pub(crate) log: Log,
}

impl State {
    /// The state at version 0: the nodes that stand for agents and resources, nothing else.
    pub(crate) fn new(vocabulary: Arc<Vocabulary>) -> Self {
        let mut state = Self::empty(vocabulary);
        let vocabulary = Arc::clone(&state.vocabulary);
        let agents = vocabulary.agents().filter_map(|id| Some((vocabulary.agent_name(id)?, TypeId::AGENT)));
        let resources =
            vocabulary.resources().filter_map(|id| Some((vocabulary.resource_name(id)?, TypeId::RESOURCE)));
        for (index, (name, node_type)) in agents.chain(resources).enumerate() {
            state.insert_node(NodeId::at(index), name.clone(), node_type, Version(0));
        }
        state.log.clear();
        state
    }

    pub(crate) fn empty(vocabulary: Arc<Vocabulary>) -> Self {
        let types = vocabulary.types().count();
        Self {
            vocabulary,
            version: Version(0),
            time: Time(0),
            next: NodeId(0),
            blocks: Pages::default(),
            frames: Pages::default(),
            names: Names::default(),
            members: Members::new(types),
            root: None,
            reflexes: Registry::default(),
            log: Log::default(),
        }
    }

    pub(crate) fn node(&self, id: NodeId) -> Option<Node<'_>> {
        let (block, slot) = place(id);
        self.blocks.get(block)?.node(slot)
    }

    /// All nodes, by id.
    pub(crate) fn nodes(&self) -> impl Iterator<Item = (NodeId, Node<'_>)> {
        self.blocks.iter().flat_map(|(at, block)| {
            block.nodes().map(move |(slot, node)| (NodeId::at(at * NODES + slot), node))
        })
    }

    /// The blocks that are not the same in both states, by index.
    pub(crate) fn differing(&self, other: &Self) -> Vec<usize> {
        let mut blocks = self.blocks.differing(&other.blocks);
        blocks.extend(self.frames.differing(&other.frames));
        blocks.sort_unstable();
        blocks.dedup();
        blocks
    }

    /// Reads what writing at a node will need, for nothing but to have it in the cache: see `transaction::apply`.
    pub(crate) fn warm(&self, id: NodeId, side: Side) -> usize {
        let (block, slot) = place(id);
        let Some(block) = self.blocks.get(block) else { return 0 };
        let known = usize::from(block.node(slot).is_some());
        known
            + match side {
                Side::Start => {
                    let edge = block.outgoing.get(slot).first().map_or(0, |edge| edge.to.index());
                    edge + block.edge_cells.get(slot).first().map_or(0, |cell| cell.to.index())
                }
                Side::End => block.incoming.get(slot).first().map_or(0, |(_, from)| from.index()),
                Side::Holder => block.cells.get(slot).first().map_or(0, |cell| cell.attribute.index()),
            }
    }

    pub(crate) fn edge(&self, key: EdgeKey) -> Option<&Edge> {
        self.node(key.from)?.edge(key.label, key.to)
    }

    pub(crate) fn cell(&self, holder: Holder, attribute: AttributeId) -> Option<&Cell> {
        match holder {
            Holder::Node(node) => self.node(node)?.cell(attribute),
            Holder::Edge(key) => self.node(key.from)?.edge_cell(key.label, key.to, attribute),
        }
    }

    /// How a node hangs below its parent.
    pub(crate) fn joint(&self, id: NodeId) -> Option<&Joint> {
        let (block, slot) = place(id);
        self.frames.get(block)?.joints[slot].as_ref()
    }

    /// The block with the joints of sixteen nodes, for walks that stay in one.
    pub(crate) fn frames(&self, block: usize) -> Option<&Frames> {
        self.frames.get(block)
    }

    /// What hangs below a node, ascending.
    pub(crate) fn children(&self, id: NodeId) -> &[NodeId] {
        let (block, slot) = place(id);
        self.frames.get(block).map_or(&[], |frames| frames.children.get(slot))
    }

    /// Whether the node takes part in the geometric quiver as a root: children but no parent.
    pub(crate) fn is_root(&self, id: NodeId) -> bool {
        self.joint(id).is_none() && !self.children(id).is_empty()
    }

    /// The nodes of exactly this type, ascending.
    pub(crate) fn nodes_exactly(&self, node_type: TypeId) -> impl Iterator<Item = NodeId> + '_ {
        self.members.of(node_type)
    }

    /// How many nodes are exactly of this type.
    pub(crate) fn count_exactly(&self, node_type: TypeId) -> usize {
        self.members.count(node_type)
    }

    pub(crate) fn insert_node(&mut self, id: NodeId, name: Arc<str>, node_type: TypeId, since: Version) {
        self.log.entries.push(Undo::NodeAdded(id));
        self.log.mentions.add_type(node_type);
        self.put_node(id, name, node_type, since);
        self.next = self.next.max(NodeId(id.0 + 1));
    }

    /// Removes a node with all that touches it.
    pub(crate) fn remove_node(&mut self, id: NodeId) {
        let Some(node) = self.node(id) else { return };
        let (node_type, since) = (node.node_type(), node.since());
        let referrers = node.referrers().to_vec();
        let attributes: Vec<_> = node.cells().iter().map(|cell| cell.attribute).collect();
        let ends = node.outgoing().iter().map(|edge| EdgeKey { from: id, label: edge.label, to: edge.to });
        let starts = node.incoming().iter().map(|&(label, from)| EdgeKey { from, label, to: id });
        let edges: Vec<_> = ends.chain(starts).collect();
        for (holder, attribute) in referrers {
            self.remove_attribute(holder, attribute);
        }
        for edge in edges {
            self.remove_edge(edge);
        }
        for attribute in attributes {
            self.remove_attribute(Holder::Node(id), attribute);
        }
        for child in self.children(id).to_vec() {
            self.remove_transform(child);
        }
        self.remove_transform(id);
        if let Some(name) = self.take_node(id) {
            self.log.entries.push(Undo::NodeRemoved { node: id, name, node_type, since });
        }
        self.log.mentions.add_type(node_type);
    }

    /// Adds an edge between nodes that exist, unless it is there.
    pub(crate) fn insert_edge(&mut self, edge: EdgeKey, since: Version) {
        if self.edge(edge).is_none() {
            self.log.entries.push(Undo::EdgeAdded(edge));
            self.log.mentions.add_label(edge.label);
            self.put_edge(edge, since);
        }
    }

    /// Removes an edge with its attributes, if it is there.
    pub(crate) fn remove_edge(&mut self, edge: EdgeKey) {
        let EdgeKey { from, label, to } = edge;
        let Some(node) = self.node(from) else { return };
        let Some(since) = node.edge(label, to).map(|edge| edge.since) else { return };
        let attributes: Vec<_> = node.edge_cells(label, to).iter().map(|e| e.cell.attribute).collect();
        for attribute in attributes {
            self.remove_attribute(Holder::Edge(edge), attribute);
        }
        self.log.entries.push(Undo::EdgeRemoved { edge, since });
        self.log.mentions.add_label(label);
        self.take_edge(edge);
    }

    /// Writes an attribute of a holder that exists, unless the value is the same.
    pub(crate) fn insert_attribute(
        &mut self,
        holder: Holder,
        attribute: AttributeId,
        value: Value,
        since: Version,
    ) {
        if self.cell(holder, attribute).is_some_and(|cell| cell.value.same(&value)) {
            return;
        }
        let old = self.put_cell(holder, attribute, Some(Cell { value, since, attribute }));
        self.log_cell(holder, attribute, old);
    }

    /// Removes an attribute, if it is there.
    pub(crate) fn remove_attribute(&mut self, holder: Holder, attribute: AttributeId) {
        if self.cell(holder, attribute).is_some() {
            let old = self.put_cell(holder, attribute, None);
            self.log_cell(holder, attribute, old);
        }
    }

    fn log_cell(&mut self, holder: Holder, attribute: AttributeId, old: Option<Cell>) {
        let old = old.map(|cell| (cell.value, cell.since));
        self.log.entries.push(Undo::Cell { holder, attribute, old });
        self.log.mentions.add_attribute(attribute);
    }

    /// Hangs `child` below `parent`; the child must have no other parent.
    pub(crate) fn insert_transform(&mut self, parent: NodeId, child: NodeId, pose: Pose, since: Version) {
        let same = |joint: &Joint| joint.parent == parent && joint.track.is_none() && joint.pose.same(&pose);
        if self.joint(child).is_some_and(same) {
            return;
        }
        let old = self.put_joint(child, Some(Joint { parent, pose, since, track: None, newest: Time(0) }));
        self.log.entries.push(Undo::Joint { child, old });
        self.log.mentions.add_transforms();
    }

    /// Says where `child` was below `parent` at a time; the child must have no other parent. What is older than the
    /// edge's buffer is left out.
    pub(crate) fn insert_sample(
        &mut self,
        parent: NodeId,
        child: NodeId,
        time: Time,
        pose: Pose,
        since: Version,
    ) {
        self.log.mentions.add_transforms();
        let Some(track) = self.joint(child).and_then(|joint| joint.track.as_ref()) else {
            let track = Some(Arc::new(Track::new(time, pose.clone())));
            let old = self.put_joint(child, Some(Joint { parent, pose, since, track, newest: time }));
            self.log.entries.push(Undo::Joint { child, old });
            return;
        };
        if time < track.horizon() || track.sample(time).is_some_and(|old| old.same(&pose)) {
            return;
        }
        if let Some(joint) = self.joint_mut(child)
            && let Some(track) = &mut joint.track
        {
            let newer = time >= track.newest();
            let old = Arc::make_mut(track).put(time, pose.clone());
            let entry = Undo::Sample { child, time, old, newest: joint.pose.clone(), since: joint.since };
            if newer {
                (joint.pose, joint.since, joint.newest) = (pose, since, time);
            }
            self.log.entries.push(entry);
        }
    }

    pub(crate) fn restore_sample(
        &mut self,
        child: NodeId,
        time: Time,
        old: Option<Pose>,
        newest: Pose,
        since: Version,
    ) {
        if let Some(joint) = self.joint_mut(child)
            && let Some(track) = &mut joint.track
        {
            match old {
                Some(pose) => _ = Arc::make_mut(track).put(time, pose),
                None => Arc::make_mut(track).take(time),
            }
            (joint.pose, joint.since, joint.newest) = (newest, since, track.newest());
        }
    }

    /// Lets go of the poses of an edge that nobody can see any more.
    pub(crate) fn evict(&mut self, child: NodeId) {
        if let Some(track) = self.joint_mut(child).and_then(|joint| joint.track.as_mut())
            && track.has_invisible()
        {
            Arc::make_mut(track).evict();
        }
    }

    fn joint_mut(&mut self, child: NodeId) -> Option<&mut Joint> {
        let (block, slot) = place(child);
        self.frames.get_mut(block)?.joints[slot].as_mut()
    }

    /// Takes `child` off its parent, if it has one.
    pub(crate) fn remove_transform(&mut self, child: NodeId) {
        if self.joint(child).is_some() {
            let old = self.put_joint(child, None);
            self.log.entries.push(Undo::Joint { child, old });
            self.log.mentions.add_transforms();
        }
    }

    // What follows writes no log: it is what the edits above and `undo` are made of.

    pub(crate) fn put_node(&mut self, id: NodeId, name: Arc<str>, node_type: TypeId, since: Version) {
        let (block, slot) = place(id);
        self.blocks.make(block).set_head(slot, Some((node_type, since)));
        self.names.insert(name, id);
        self.members.insert(node_type, id);
    }

    /// Takes away a node on which nothing hangs; gives its name.
    pub(crate) fn take_node(&mut self, id: NodeId) -> Option<Arc<str>> {
        let node_type = self.node(id)?.node_type();
        let (block, slot) = place(id);
        self.blocks.get_mut(block)?.set_head(slot, None);
        self.members.remove(node_type, id);
        self.names.remove(id)
    }

    pub(crate) fn put_edge(&mut self, EdgeKey { from, label, to }: EdgeKey, since: Version) {
        if let Some((block, slot)) = self.block_mut(from)
            && let Err(at) =
                block.outgoing.get(slot).binary_search_by_key(&(label, to), |edge| (edge.label, edge.to))
        {
            block.outgoing.insert(slot, at, Edge { since, label, to });
        }
        if let Some((block, slot)) = self.block_mut(to) {
            block.incoming.add(slot, (label, from));
        }
    }

    /// Takes away an edge that has no attributes.
    pub(crate) fn take_edge(&mut self, EdgeKey { from, label, to }: EdgeKey) {
        if let Some((block, slot)) = self.block_mut(from)
            && let Ok(at) =
                block.outgoing.get(slot).binary_search_by_key(&(label, to), |edge| (edge.label, edge.to))
        {
            block.outgoing.remove(slot, at);
        }
        if let Some((block, slot)) = self.block_mut(to) {
            block.incoming.take(slot, (label, from));
        }
    }

    /// Gives an attribute a value or takes it away; gives what was there.
    pub(crate) fn put_cell(
        &mut self,
        holder: Holder,
        attribute: AttributeId,
        cell: Option<Cell>,
    ) -> Option<Cell> {
        let target = |cell: &Option<Cell>| cell.as_ref().and_then(|cell| cell.value.as_node());
        let new_target = target(&cell);
        let old = match holder {
            Holder::Node(node) => {
                let (block, slot) = self.block_mut(node)?;
                let run = &mut block.cells;
                let found = run.get(slot).binary_search_by_key(&attribute, |cell| cell.attribute);
                match (found, cell) {
                    (Ok(at), Some(cell)) => Some(std::mem::replace(&mut run.get_mut(slot)[at], cell)),
                    (Ok(at), None) => Some(run.remove(slot, at)),
                    (Err(at), Some(cell)) => {
                        run.insert(slot, at, cell);
                        None
                    }
                    (Err(_), None) => None,
                }
            }
            Holder::Edge(EdgeKey { from, label, to }) => {
                let (block, slot) = self.block_mut(from)?;
                let run = &mut block.edge_cells;
                let key = |e: &EdgeCell| (e.label, e.to, e.cell.attribute);
                let found = run.get(slot).binary_search_by_key(&(label, to, attribute), key);
                match (found, cell) {
                    (Ok(at), Some(cell)) => Some(std::mem::replace(&mut run.get_mut(slot)[at].cell, cell)),
                    (Ok(at), None) => Some(run.remove(slot, at).cell),
                    (Err(at), Some(cell)) => {
                        run.insert(slot, at, EdgeCell { cell, label, to });
                        None
                    }
                    (Err(_), None) => None,
                }
            }
        };
        let old_target = target(&old);
        if old_target != new_target {
            if let Some((block, slot)) = old_target.and_then(|id| self.block_mut(id)) {
                block.referrers.take(slot, (holder, attribute));
            }
            if let Some((block, slot)) = new_target.and_then(|id| self.block_mut(id)) {
                block.referrers.add(slot, (holder, attribute));
            }
        }
        old
    }

    /// Hangs a node or takes it off; gives how it hung.
    pub(crate) fn put_joint(&mut self, child: NodeId, joint: Option<Joint>) -> Option<Joint> {
        let (block, slot) = place(child);
        let parent = joint.as_ref().map(|joint| joint.parent);
        let old = std::mem::replace(&mut self.frames.make(block).joints[slot], joint);
        let before = old.as_ref().map(|joint| joint.parent);
        if before != parent {
            if let Some(before) = before {
                let (block, slot) = place(before);
                self.frames.make(block).children.take(slot, child);
            }
            if let Some(parent) = parent {
                let (block, slot) = place(parent);
                self.frames.make(block).children.add(slot, child);
            }
        }
        old
    }

    /// Gives what turned out to be the same after all the version in which it was written.
    pub(crate) fn keep_since(&mut self, kept: Kept, since: Version) {
        match kept {
            Kept::Edge(EdgeKey { from, label, to }) => {
                if let Some((block, slot)) = self.block_mut(from)
                    && let Some(edge) = block
                        .outgoing
                        .get_mut(slot)
                        .iter_mut()
                        .find(|edge| (edge.label, edge.to) == (label, to))
                {
                    edge.since = since;
                }
            }
            Kept::Cell(holder, attribute) => {
                if let Some(mut cell) = self.cell(holder, attribute).cloned() {
                    cell.since = since;
                    self.put_cell(holder, attribute, Some(cell));
                }
            }
            Kept::Joint(child) => {
                if let Some(joint) = self.joint_mut(child) {
                    joint.since = since;
                }
            }
        }
    }

    fn block_mut(&mut self, id: NodeId) -> Option<(&mut Block, usize)> {
        let (block, slot) = place(id);
        Some((self.blocks.get_mut(block)?, slot))
    }

    /// The name of a node, for errors and sentences; of an agent too, since its node never goes.
    pub(crate) fn name(&self, id: NodeId) -> Arc<str> {
        self.names.of(id).cloned().unwrap_or_else(|| id.to_string().into())
    }

    pub(crate) fn agent_name(&self, id: AgentId) -> Arc<str> {
        self.vocabulary.agent_name(id).cloned().unwrap_or_else(|| id.to_string().into())
    }
}

/// What an edit needs of a node.
#[derive(Debug, Clone, Copy)]
pub(crate) enum Side {
    /// The edges that leave it.
    Start,
    /// The edges that reach it.
    End,
    /// Its attributes.
    Holder,
}

/// What has a version of its own.
#[derive(Debug, Clone, Copy)]
pub(crate) enum Kept {
    Edge(EdgeKey),
    Cell(Holder, AttributeId),
    Joint(NodeId),
}
