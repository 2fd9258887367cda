//! Nodes for some of the variables of a pattern.

use smallvec::SmallVec;

use crate::id::NodeId;

/// Nodes for some of the variables.
pub(crate) type Fixed = SmallVec<[(usize, NodeId); 2]>;

/// The matches that a delta may have changed: all, or those with these nodes.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Slices {
    All,
    These(SmallVec<[Fixed; 4]>),
}
