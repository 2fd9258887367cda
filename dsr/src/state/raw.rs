//! Unlogged edits: what logged edits, rollback and replay on the second copy are made of.

use std::sync::Arc;

use super::State;
use crate::block::{Block, Cell, Edge, EdgeCell, Joint, place};
use crate::id::{AttributeId, EdgeKey, Holder, NodeId, Time, TypeId, Version};
use crate::pose::Pose;

impl State {
    /// Undoes a sample: puts back the pose of that time and the newest pose.
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

    /// Frees the poses of a track that lie beyond its horizon.
    pub(crate) fn evict(&mut self, child: NodeId) {
        if let Some(track) = self.joint_mut(child).and_then(|joint| joint.track.as_mut())
            && track.has_invisible()
        {
            Arc::make_mut(track).evict();
        }
    }

    pub(super) fn joint_mut(&mut self, child: NodeId) -> Option<&mut Joint> {
        let (block, slot) = place(child);
        self.frames.get_mut(block)?.joints[slot].as_mut()
    }

    /// Adds a node.
    pub(crate) fn put_node(&mut self, id: NodeId, name: Arc<str>, node_type: TypeId, since: Version) {
        let (block, slot) = place(id);
        self.blocks.make(block).set_head(slot, Some((node_type, since)));
        self.names.insert(name, id);
        self.members.insert(node_type, id);
    }

    /// Removes a node that has no edge, attribute or transform. Returns its name.
    pub(crate) fn take_node(&mut self, id: NodeId) -> Option<Arc<str>> {
        let node_type = self.node(id)?.node_type();
        let (block, slot) = place(id);
        self.blocks.get_mut(block)?.set_head(slot, None);
        self.members.remove(node_type, id);
        self.names.remove(id)
    }

    /// Adds an edge, at both of its ends.
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

    /// Removes an edge that has no attributes.
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

    /// Sets or removes an attribute. Returns the old value.
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

    /// Sets or removes the transform from a node to its parent. Returns the old one.
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

    /// Restores the version of something that was written again with the value that it had.
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
}

/// What carries the version that wrote it.
#[derive(Debug, Clone, Copy)]
pub(crate) enum Kept {
    Edge(EdgeKey),
    Cell(Holder, AttributeId),
    Joint(NodeId),
}
