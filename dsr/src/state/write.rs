//! Logged edits. Each logs what it overwrites, then writes it with a raw edit.
//!
//! An edit that changes nothing logs nothing. Edits check no rule: the caller has done so (`transaction::check`,
//! `replay_check`).

use std::sync::Arc;

use super::State;
use super::log::Undo;
use crate::block::{Cell, Joint};
use crate::id::{AttributeId, EdgeKey, Holder, NodeId, Time, TypeId, Version};
use crate::pose::Pose;
use crate::track::Track;
use crate::value::Value;
use crate::vocabulary::Vocabulary;

impl State {
    /// The state at version 0: only the nodes that stand for agents and resources.
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

    /// Adds a node with an id that no node has.
    pub(crate) fn insert_node(&mut self, id: NodeId, name: Arc<str>, node_type: TypeId, since: Version) {
        self.log.entries.push(Undo::NodeAdded(id));
        self.log.mentions.add_type(node_type);
        self.put_node(id, name, node_type, since);
        self.next = self.next.max(NodeId(id.0 + 1));
    }

    /// Removes a node with its edges, attributes and transforms, and with the attributes that refer to it.
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

    /// Adds an edge between nodes that exist, unless the edge exists.
    pub(crate) fn insert_edge(&mut self, edge: EdgeKey, since: Version) {
        if self.edge(edge).is_none() {
            self.log.entries.push(Undo::EdgeAdded(edge));
            self.log.mentions.add_label(edge.label);
            self.put_edge(edge, since);
        }
    }

    /// Removes an edge with its attributes, if it exists.
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

    /// Removes an attribute, if it has a value.
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

    /// Sets the pose of `child` in `parent`. The child must not have another parent.
    pub(crate) fn insert_transform(&mut self, parent: NodeId, child: NodeId, pose: Pose, since: Version) {
        let same = |joint: &Joint| joint.parent == parent && joint.track.is_none() && joint.pose.same(&pose);
        if self.joint(child).is_some_and(same) {
            return;
        }
        let old = self.put_joint(child, Some(Joint { parent, pose, since, track: None, newest: Time(0) }));
        self.log.entries.push(Undo::Joint { child, old });
        self.log.mentions.add_transforms();
    }

    /// Adds the pose of `child` in `parent` at a time. The child must not have another parent. A sample older than the
    /// horizon of the track is ignored.
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

    /// Removes the transform from `child` to its parent, if it has one.
    pub(crate) fn remove_transform(&mut self, child: NodeId) {
        if self.joint(child).is_some() {
            let old = self.put_joint(child, None);
            self.log.entries.push(Undo::Joint { child, old });
            self.log.mentions.add_transforms();
        }
    }
}
