//! One state of the graph: the value behind a snapshot.
//!
//! Sixteen nodes share a block. Blocks are in pages, which are copied on write only while a snapshot holds them. Names
//! and poses have pages of their own. This file has the fields and reads them; the modules below write:
//!
//! 1. `raw`: unlogged edits. Each keeps the indexes in step: an edge is listed at both ends, a transform at parent and
//!    child, a reference at the node that it refers to.
//! 2. `log`: the record of what a transaction has overwritten.
//! 3. `write`: logged edits, made of raw ones. They check no rule; `transaction::check` does.
//! 4. `rollback`: undoing what was logged.
//!
//! Cost: a copy is a few reference counts. An edit is a binary search in one or two blocks, and copies each block once
//! if a snapshot holds it.

pub(crate) mod log;
mod raw;
mod rollback;
pub(crate) mod warm;
mod write;

use std::sync::Arc;

pub(crate) use self::raw::Kept;

use self::log::Log;
use crate::block::{Block, Cell, Edge, Frames, Joint, NODES, Node, place};
use crate::id::{AgentId, AttributeId, EdgeKey, Holder, NodeId, Time, TypeId, Version};
use crate::members::Members;
use crate::names::Names;
use crate::pages::Pages;
use crate::vocabulary::Vocabulary;

/// A state of the graph.
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
    /// The root of the geometric quiver, if it has any edge.
    pub(crate) root: Option<NodeId>,
    pub(crate) log: Log,
}

impl State {
    /// A state without any node.
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

    /// The indexes of the blocks that the two states do not share.
    pub(crate) fn differing(&self, other: &Self) -> Vec<usize> {
        let mut blocks = self.blocks.differing(&other.blocks);
        blocks.extend(self.frames.differing(&other.frames));
        blocks.sort_unstable();
        blocks.dedup();
        blocks
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

    /// The transform from a node to its parent.
    pub(crate) fn joint(&self, id: NodeId) -> Option<&Joint> {
        let (block, slot) = place(id);
        self.frames.get(block)?.joints[slot].as_ref()
    }

    /// The transforms of sixteen nodes, for walks that stay in one block.
    pub(crate) fn frames(&self, block: usize) -> Option<&Frames> {
        self.frames.get(block)
    }

    /// The nodes whose parent is this one, ascending.
    pub(crate) fn children(&self, id: NodeId) -> &[NodeId] {
        let (block, slot) = place(id);
        self.frames.get(block).map_or(&[], |frames| frames.children.get(slot))
    }

    /// Whether the node is a root of the geometric quiver: it has children and no parent.
    pub(crate) fn is_root(&self, id: NodeId) -> bool {
        self.joint(id).is_none() && !self.children(id).is_empty()
    }

    /// The nodes of exactly this type, ascending.
    pub(crate) fn nodes_exactly(&self, node_type: TypeId) -> impl Iterator<Item = NodeId> + '_ {
        self.members.of(node_type)
    }

    /// The number of nodes of exactly this type.
    pub(crate) fn count_exactly(&self, node_type: TypeId) -> usize {
        self.members.count(node_type)
    }

    /// The name of a node, or its number if it does not exist: for errors and sentences.
    pub(crate) fn name(&self, id: NodeId) -> Arc<str> {
        self.names.of(id).cloned().unwrap_or_else(|| id.to_string().into())
    }

    pub(crate) fn agent_name(&self, id: AgentId) -> Arc<str> {
        self.vocabulary.agent_name(id).cloned().unwrap_or_else(|| id.to_string().into())
    }
}
