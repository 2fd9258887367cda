//! Sixteen nodes as a few flat lists: what one page of the graph holds.
//!
//! Problem: a node with one list for each kind of content costs six allocations to read, to copy for a snapshot, and to
//! count references of. Idea: nodes with neighbouring ids share one list per kind, sorted by node, beside a table of
//! where each node's run ends. Copying a block is then a few memory copies, and its lists lie together in the cache.
//! Invariant: a run is sorted by the key that its items are found by. Cost: finding is a binary search in the node's
//! run; inserting moves the runs of up to fifteen nodes after it.

use std::ops::Range;
use std::sync::Arc;

use crate::id::{AttributeId, Holder, LabelId, NodeId, Time, TypeId, Version};
use crate::pose::Pose;
use crate::track::Track;
use crate::value::Value;

/// The number of nodes in a block.
pub(crate) const NODES: usize = 16;

/// The block and the slot in it of a node.
pub(crate) const fn place(id: NodeId) -> (usize, usize) {
    (id.index() / NODES, id.index() % NODES)
}

/// A list per node of a block.
#[derive(Debug, Clone)]
pub(crate) struct Runs<T> {
    items: Vec<T>,
    ends: [u32; NODES],
}

impl<T> Default for Runs<T> {
    fn default() -> Self {
        Self { items: Vec::new(), ends: [0; NODES] }
    }
}

impl<T> Runs<T> {
    fn range(&self, slot: usize) -> Range<usize> {
        let start = if slot == 0 { 0 } else { self.ends[slot - 1] };
        start as usize..self.ends[slot] as usize
    }

    pub(crate) fn get(&self, slot: usize) -> &[T] {
        &self.items[self.range(slot)]
    }

    pub(crate) fn get_mut(&mut self, slot: usize) -> &mut [T] {
        let range = self.range(slot);
        &mut self.items[range]
    }

    /// Inserts at a position of the node's run.
    pub(crate) fn insert(&mut self, slot: usize, at: usize, item: T) {
        if self.items.len() == self.items.capacity() {
            // Growth by an eighth, not by half: otherwise the spare room of a million lists is most of their memory.
            self.items.reserve_exact(4.max(self.items.len() / 8));
        }
        let at = self.range(slot).start + at;
        self.items.insert(at, item);
        self.ends[slot..].iter_mut().for_each(|end| *end += 1);
    }

    /// Removes from a position of the node's run.
    pub(crate) fn remove(&mut self, slot: usize, at: usize) -> T {
        let at = self.range(slot).start + at;
        self.ends[slot..].iter_mut().for_each(|end| *end -= 1);
        self.items.remove(at)
    }
}

impl<T: Ord + Copy> Runs<T> {
    pub(crate) fn add(&mut self, slot: usize, item: T) {
        if let Err(at) = self.get(slot).binary_search(&item) {
            self.insert(slot, at, item);
        }
    }

    pub(crate) fn take(&mut self, slot: usize, item: T) {
        if let Ok(at) = self.get(slot).binary_search(&item) {
            self.remove(slot, at);
        }
    }
}

/// An attribute with its value.
#[derive(Debug, Clone)]
pub(crate) struct Cell {
    pub(crate) value: Value,
    pub(crate) since: Version,
    pub(crate) attribute: AttributeId,
}

/// An edge, listed where it starts.
#[derive(Debug, Clone)]
pub(crate) struct Edge {
    pub(crate) since: Version,
    pub(crate) label: LabelId,
    pub(crate) to: NodeId,
}

/// An attribute of an edge, listed where the edge starts.
#[derive(Debug, Clone)]
pub(crate) struct EdgeCell {
    pub(crate) cell: Cell,
    pub(crate) label: LabelId,
    pub(crate) to: NodeId,
}

#[derive(Debug, Clone, Copy)]
struct Head {
    since: Version,
    node_type: TypeId,
}

/// The head of a node that does not exist; no node has this type.
const ABSENT: Head = Head { since: Version(0), node_type: TypeId(u32::MAX) };

#[derive(Debug, Clone)]
pub(crate) struct Block {
    heads: [Head; NODES],
    /// Sorted by attribute.
    pub(crate) cells: Runs<Cell>,
    /// Sorted by label and end.
    pub(crate) outgoing: Runs<Edge>,
    /// Sorted by label and start.
    pub(crate) incoming: Runs<(LabelId, NodeId)>,
    /// Sorted by label, end and attribute.
    pub(crate) edge_cells: Runs<EdgeCell>,
    /// The attributes of other nodes and edges whose value is this node.
    pub(crate) referrers: Runs<(Holder, AttributeId)>,
}

impl Default for Block {
    fn default() -> Self {
        Self {
            heads: [ABSENT; NODES],
            cells: Runs::default(),
            outgoing: Runs::default(),
            incoming: Runs::default(),
            edge_cells: Runs::default(),
            referrers: Runs::default(),
        }
    }
}

impl Block {
    pub(crate) fn node(&self, slot: usize) -> Option<Node<'_>> {
        (self.heads[slot].node_type != ABSENT.node_type).then_some(Node { block: self, slot })
    }

    pub(crate) fn nodes(&self) -> impl Iterator<Item = (usize, Node<'_>)> {
        (0..NODES).filter_map(|slot| Some((slot, self.node(slot)?)))
    }

    pub(crate) fn set_head(&mut self, slot: usize, head: Option<(TypeId, Version)>) {
        self.heads[slot] = head.map_or(ABSENT, |(node_type, since)| Head { since, node_type });
    }
}

/// A node in its block.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Node<'a> {
    block: &'a Block,
    slot: usize,
}

impl<'a> Node<'a> {
    pub(crate) fn node_type(self) -> TypeId {
        self.block.heads[self.slot].node_type
    }

    pub(crate) fn since(self) -> Version {
        self.block.heads[self.slot].since
    }

    pub(crate) fn cells(self) -> &'a [Cell] {
        self.block.cells.get(self.slot)
    }

    pub(crate) fn outgoing(self) -> &'a [Edge] {
        self.block.outgoing.get(self.slot)
    }

    pub(crate) fn incoming(self) -> &'a [(LabelId, NodeId)] {
        self.block.incoming.get(self.slot)
    }

    pub(crate) fn referrers(self) -> &'a [(Holder, AttributeId)] {
        self.block.referrers.get(self.slot)
    }

    pub(crate) fn cell(self, attribute: AttributeId) -> Option<&'a Cell> {
        let cells = self.cells();
        cells.binary_search_by_key(&attribute, |cell| cell.attribute).ok().map(|at| &cells[at])
    }

    pub(crate) fn edge(self, label: LabelId, to: NodeId) -> Option<&'a Edge> {
        let edges = self.outgoing();
        edges.binary_search_by_key(&(label, to), |e| (e.label, e.to)).ok().map(|at| &edges[at])
    }

    /// The edges with one label: a contiguous run of the sorted list.
    pub(crate) fn edges(self, label: LabelId) -> &'a [Edge] {
        let edges = self.outgoing();
        let start = edges.partition_point(|e| e.label < label);
        let end = start + edges[start..].partition_point(|e| e.label == label);
        &edges[start..end]
    }

    /// The starts of the edges with one label that end here.
    pub(crate) fn sources(self, label: LabelId) -> &'a [(LabelId, NodeId)] {
        let edges = self.incoming();
        let start = edges.partition_point(|(l, _)| *l < label);
        let end = start + edges[start..].partition_point(|(l, _)| *l == label);
        &edges[start..end]
    }

    /// The attributes of an edge that starts here.
    pub(crate) fn edge_cells(self, label: LabelId, to: NodeId) -> &'a [EdgeCell] {
        let cells = self.block.edge_cells.get(self.slot);
        let start = cells.partition_point(|e| (e.label, e.to) < (label, to));
        let end = start + cells[start..].partition_point(|e| (e.label, e.to) == (label, to));
        &cells[start..end]
    }

    pub(crate) fn edge_cell(self, label: LabelId, to: NodeId, attribute: AttributeId) -> Option<&'a Cell> {
        let cells = self.block.edge_cells.get(self.slot);
        let key = |e: &EdgeCell| (e.label, e.to, e.cell.attribute);
        cells.binary_search_by_key(&(label, to, attribute), key).ok().map(|at| &cells[at].cell)
    }
}

/// The transform from a node to its parent in the geometric quiver.
#[derive(Debug, Clone)]
pub(crate) struct Joint {
    pub(crate) parent: NodeId,
    pub(crate) pose: Pose,
    pub(crate) since: Version,
    /// The stamped poses of a moving frame, of which `pose` is the newest; `None` for a static frame.
    pub(crate) track: Option<Arc<Track>>,
    /// The time of the newest of them.
    pub(crate) newest: Time,
}

/// The transforms of a block of nodes. They are kept apart because most nodes have none, and poses change most often.
#[derive(Debug, Clone, Default)]
pub(crate) struct Frames {
    pub(crate) joints: [Option<Joint>; NODES],
    /// Sorted by id.
    pub(crate) children: Runs<NodeId>,
}
