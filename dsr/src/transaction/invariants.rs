//! Second stage: the rules for the graph as a whole, checked once after all edits.
//!
//! So a node can change its parent by a removal and an addition in one transaction, in either order.

use super::error::TransactionError;
use super::{degree, tree};
use crate::state::State;
use crate::state::log::Mark;

/// Checks what was edited since the mark, and finds the root of the geometric quiver.
pub(crate) fn check(state: &mut State, mark: Mark) -> Result<(), TransactionError> {
    if state.log.mentions.transforms() {
        state.root = tree::check(state, mark)?;
    }
    degree::check(state, mark)
}
