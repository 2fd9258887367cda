//! Loading what a transaction will need into the cache, before it begins.
//!
//! Problem: to check and write an edit is a chain of loads that wait for one another, and in a large graph each comes
//! from main memory. Idea: read the first entry of each list that the edits will touch, for all edits at once; the
//! loads then overlap.

use super::State;
use crate::block::place;
use crate::id::NodeId;

/// The part of a node that an edit reads.
#[derive(Debug, Clone, Copy)]
pub(crate) enum Side {
    /// Its outgoing edges.
    Start,
    /// Its incoming edges.
    End,
    /// Its attributes.
    Holder,
}

impl State {
    /// Reads what an edit of this node will need. The result has no meaning, but keeps the compiler from dropping the
    /// reads.
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
}
