//! Open lists of successors that are not generated yet.
//!
//! Problem: a search with deferred evaluation queues every successor of a visited state in every
//! open list, and a state can have thousands of successors. Idea: an arena stores the operators of
//! a state once. The lists hold their position in the arena and how many were taken. Invariant: a
//! list of runs gives the same edges in the same order as a list of single edges. Cost: four bytes
//! an edge, and a few bytes for each list.

use super::open_list::OpenList;
use crate::ids::{OperatorId, StateId, id32};
use crate::query::UNLIMITED;

/// Operators in one piece of the arena; pieces never move.
const PIECE: usize = 1 << 18;
/// Keeps positions well below 2^32.
const MOST_PIECES: usize = 16_000;

/// A state and an operator that is applicable in it.
pub(crate) type Edge = (StateId, OperatorId);

/// Consecutive operators in the arena that are applicable in one state.
#[derive(Clone, Copy)]
pub(crate) struct Run {
    state: StateId,
    at: u32,
    end: u32,
}

/// Stores the operators of all runs.
#[derive(Default)]
pub(crate) struct Arena {
    pieces: Vec<Vec<OperatorId>>,
}

impl Arena {
    /// Stores the operators and calls `each` for each run. There is more than one run only if there
    /// are more than [`PIECE`] operators.
    pub(crate) fn keep(&mut self, state: StateId, operators: &[OperatorId], mut each: impl FnMut(Run)) {
        for part in operators.chunks(PIECE) {
            match self.pieces.last() {
                // Small searches never fill a piece, so none is reserved.
                None => self.pieces.push(Vec::new()),
                Some(last) if last.len() + part.len() > PIECE => self.pieces.push(Vec::with_capacity(PIECE)),
                Some(_) => {}
            }
            let piece = self.pieces.len() - 1;
            let at = id32(piece * PIECE + self.pieces[piece].len());
            self.pieces[piece].extend_from_slice(part);
            each(Run { state, at, end: at + id32(part.len()) });
        }
    }

    /// Removes and returns the first edge of a list.
    pub(crate) fn pop(&self, list: &mut OpenList<Run>) -> Option<Edge> {
        let run = list.first_mut()?;
        let at = run.at as usize;
        let edge = (run.state, self.pieces[at / PIECE][at % PIECE]);
        run.at += 1;
        if run.at == run.end {
            list.pop();
        }
        Some(edge)
    }

    /// The bytes held; more than any budget allows once positions run out.
    pub(crate) fn memory(&self) -> usize {
        match self.pieces.last() {
            None => 0,
            Some(_) if self.pieces.len() >= MOST_PIECES => UNLIMITED,
            Some(last) => ((self.pieces.len() - 1) * PIECE + last.capacity()) * size_of::<OperatorId>(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::{Arena, Edge, PIECE};
    use crate::ids::{OperatorId, StateId, id32};
    use crate::search::open_list::OpenList;

    #[test]
    fn runs_give_what_single_edges_give() {
        let (mut arena, mut runs, mut singles) = (Arena::default(), OpenList::new(), OpenList::new());
        let both = |arena: &Arena, runs: &mut OpenList<_>, singles: &mut OpenList<Edge>| {
            let expected = singles.pop();
            assert_eq!(arena.pop(runs), expected);
            expected.is_some()
        };
        // Some runs are larger than a piece, and many do not fit into the rest of one. Some keys
        // are dense, some are not.
        let sizes = [3, 0, PIECE - 2, 7, 2 * PIECE + 5, 1, 4];
        for (state, (size, key)) in sizes.into_iter().zip([2, 2, 1, 9_000, 2, 9_000, 0]).enumerate() {
            let state = StateId(id32(state));
            let operators: Vec<OperatorId> = (0..id32(size)).map(|o| OperatorId(o ^ 1)).collect();
            arena.keep(state, &operators, |run| runs.push(key, run));
            operators.iter().for_each(|&o| singles.push(key, (state, o)));
            both(&arena, &mut runs, &mut singles);
        }
        while both(&arena, &mut runs, &mut singles) {}
        assert!(arena.memory() >= sizes.iter().sum::<usize>() * 4);
    }
}
