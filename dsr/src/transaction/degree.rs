//! The most edges of a label that a node may have: checked once, at the end of a transaction, so that an edge can
//! replace another one in any order.
//!
//! Cost: two binary searches per new edge; nothing in a vocabulary without limits.

use super::error::TransactionError;
use crate::block::Node;
use crate::id::{LabelId, NodeId};
use crate::state::State;
use crate::state::log::{Mark, Undo};

/// Checks the nodes that got an edge since the mark.
pub(super) fn check(state: &State, mark: Mark) -> Result<(), TransactionError> {
    if !state.vocabulary.has_limits() {
        return Ok(());
    }
    for entry in state.log.since(mark) {
        let Undo::EdgeAdded(key) = entry else { continue };
        let degree = state.vocabulary.degree(key.label);
        let count = |node, edges: fn(Node<'_>, LabelId) -> usize| {
            state.node(node).map_or(0, |node| edges(node, key.label))
        };
        let leaving = count(key.from, |node, label| node.edges(label).len());
        let reaching = count(key.to, |node, label| node.sources(label).len());
        let too_many = |node: NodeId, found: usize, most: Option<u32>| {
            let most = most.filter(|&most| found > most as usize)?;
            Some((state.name(node), most))
        };
        let label = || state.vocabulary.label_name(key.label).cloned().unwrap_or_default();
        if let Some((node, most)) = too_many(key.from, leaving, degree.leaving) {
            return Err(TransactionError::TooManyLeave { node, label: label(), most });
        }
        if let Some((node, most)) = too_many(key.to, reaching, degree.reaching) {
            return Err(TransactionError::TooManyReach { node, label: label(), most });
        }
    }
    Ok(())
}
