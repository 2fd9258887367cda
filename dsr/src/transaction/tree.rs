//! The geometric quiver is one rooted tree: judged once, at the end of a transaction.
//!
//! Source: Marfil et al., §3.1: acyclic, one geometric edge per pair, one simple path between any two geometric
//! nodes. Second parents are refused edit by edit; what is left is cycles (walk up from every child that moved)
//! and roots (a node with children and no parent; there may be one). A node without transforms takes no part.
//! Cost: the depth of each moved child.

use super::error::TransactionError;
use crate::id::NodeId;
use crate::state::{Node, State};

/// The root after the transaction, or what is broken.
pub(super) fn check(
    before: &State,
    after: &State,
    touched: &[NodeId],
) -> Result<Option<NodeId>, TransactionError> {
    let parent_in = |state: &State, id| state.node(id).and_then(|node| Some(node.joint.as_ref()?.parent));
    for &id in touched {
        let parent = parent_in(after, id);
        if let Some(parent) = parent
            && parent_in(before, id) != Some(parent)
            && closes_cycle(after, id)
        {
            return Err(TransactionError::Cycle { parent: after.name(parent), child: after.name(id) });
        }
    }
    let mut root = before.root.filter(|&root| after.node(root).is_some_and(Node::is_root));
    for &id in touched {
        if !after.node(id).is_some_and(Node::is_root) {
            continue;
        }
        match root {
            Some(root) if root != id => {
                let cut = [id, root].into_iter().find_map(|id| Some((parent_in(before, id)?, id)));
                return Err(match cut {
                    Some((parent, child)) => {
                        // The parent may have been removed: its name is in the state before.
                        TransactionError::Disconnected {
                            parent: before.name(parent),
                            child: after.name(child),
                        }
                    }
                    None => TransactionError::SecondRoot { root: after.name(root), other: after.name(id) },
                });
            }
            _ => root = Some(id),
        }
    }
    Ok(root)
}

/// Whether going up from `start` comes back to it. A cycle that `start` only leads into is found from the moved
/// child that lies on it, so the walk may give up after as many steps as there are ids.
fn closes_cycle(state: &State, start: NodeId) -> bool {
    let mut at = start;
    for _ in 0..=state.next.0 {
        match state.node(at).and_then(|node| node.joint.as_ref()) {
            None => return false,
            Some(joint) if joint.parent == start => return true,
            Some(joint) => at = joint.parent,
        }
    }
    false
}
