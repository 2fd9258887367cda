//! The geometric quiver is one rooted tree: checked once, at the end of a transaction.
//!
//! An edit that adds a second parent is rejected at once. What remains to check is cycles (walk up from every child
//! that moved) and roots (nodes with children and no parent: there may be one). A node without transforms is not part
//! of the tree. Cost: the nodes above the moved children.
//!
//! Source: Marfil et al., §3.1: acyclic, one geometric edge per pair, one simple path between any two geometric nodes.

use std::sync::Arc;

use rustc_hash::FxHashSet;

use super::error::TransactionError;
use crate::id::NodeId;
use crate::state::State;
use crate::state::log::{Mark, Undo};

/// The root after the edits since the mark, or the rule that they break.
pub(super) fn check(state: &State, mark: Mark) -> Result<Option<NodeId>, TransactionError> {
    let entries = state.log.since(mark);
    let parent_now = |id| state.joint(id).map(|joint| joint.parent);
    let parents = || {
        entries.iter().filter_map(|entry| match entry {
            Undo::Joint { child, old } => Some((*child, old.as_ref().map(|joint| joint.parent))),
            _ => None,
        })
    };
    // New poses of transforms that keep their parent do not change the tree.
    if parents().all(|(child, old)| old == parent_now(child)) {
        return Ok(state.root);
    }
    // The old parent of each edited child: the first entry about the child has it.
    let mut before: Vec<_> = parents().collect();
    let touched: Vec<_> = before.iter().map(|(child, _)| *child).collect();
    before.sort_by_key(|(child, _)| *child);
    before.dedup_by_key(|(child, _)| *child);
    let parent_before = |id| match before.binary_search_by_key(&id, |(child, _)| *child) {
        Ok(at) => before[at].1,
        Err(_) => parent_now(id),
    };

    // The last edit on a cycle is the one that closed it.
    let mut fine = FxHashSet::default();
    for &id in touched.iter().rev() {
        if let Some(parent) = parent_now(id)
            && parent_before(id) != Some(parent)
            && closes_cycle(state, id, &mut fine)
        {
            return Err(TransactionError::Cycle { parent: state.name(parent), child: state.name(id) });
        }
    }
    let mut root = state.root.filter(|&root| state.is_root(root));
    let ends = touched.iter().flat_map(|&id| [Some(id), parent_before(id), parent_now(id)]);
    for id in ends.flatten().filter(|&id| state.is_root(id)) {
        match root {
            Some(root) if root != id => {
                let cut = [id, root].into_iter().find_map(|id| Some((parent_before(id)?, id)));
                return Err(match cut {
                    Some((parent, child)) => TransactionError::Disconnected {
                        parent: name_before(state, entries, parent),
                        child: state.name(child),
                    },
                    None => TransactionError::SecondRoot { root: state.name(root), other: state.name(id) },
                });
            }
            _ => root = Some(id),
        }
    }
    Ok(root)
}

/// The name of a node that the transaction may have removed.
fn name_before(state: &State, entries: &[Undo], id: NodeId) -> Arc<str> {
    let removed = |entry: &Undo| match entry {
        Undo::NodeRemoved { node, name, .. } if *node == id => Some(name.clone()),
        _ => None,
    };
    entries.iter().find_map(removed).unwrap_or_else(|| state.name(id))
}

/// Whether the path up from `start` comes back to it. A cycle that does not contain `start` is found from the moved
/// child on it; this walk then ends when it meets a node twice (Brent 1980). Nodes whose path leads to a root are kept
/// in `fine`, so all walks together visit each node a few times at most.
fn closes_cycle(state: &State, start: NodeId, fine: &mut FxHashSet<NodeId>) -> bool {
    let mut path = vec![start];
    let mut mark = start;
    while let Some(parent) = path.last().and_then(|&at| state.joint(at)).map(|joint| joint.parent) {
        if parent == start {
            return true;
        }
        if fine.contains(&parent) {
            break;
        }
        if parent == mark {
            return false;
        }
        path.push(parent);
        if path.len().is_power_of_two() {
            mark = parent;
        }
    }
    fine.extend(path);
    false
}
