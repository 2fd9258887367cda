//! Processes many inputs on all cores and returns the answers in order.
//!
//! Idea: rayon's threads take one input after the other and send their answers. The caller's thread
//! restores their order, so code that writes results needs no lock.
//! Invariant: `done` is called once per input, in the order of the inputs, on the caller's thread, as soon as that
//! input and all before it are done. No thread works on more than one input, which bounds memory. Calls are not nested:
//! the caller waits, and must not be one of rayon's threads.

use rayon::iter::{ParallelBridge, ParallelIterator};
use std::collections::BTreeMap;
use std::sync::mpsc;

/// The number of inputs that are processed at once.
pub(crate) fn width() -> usize {
    rayon::current_num_threads()
}

/// Processes all inputs.
pub(crate) fn in_order<W: Sync, A: Send>(
    work: &[W],
    answer: impl Fn(&W) -> A + Sync,
    mut done: impl FnMut(&W, A),
) {
    if let [piece] = work {
        done(piece, answer(piece));
        return;
    }
    let (send, receive) = mpsc::channel();
    rayon::in_place_scope(|scope| {
        scope.spawn(|_| {
            // An indexed iterator would split the inputs into halves; a bridge hands out the next
            // input.
            let inputs = work.iter().enumerate().par_bridge();
            let sent = inputs
                .try_for_each_with(send, |send, (position, piece)| send.send((position, answer(piece))));
            // The receiver is gone only if `done` has panicked; the scope then propagates the
            // panic.
            drop(sent);
        });
        let mut early = BTreeMap::new();
        let mut awaited = 0;
        for (position, found) in receive {
            early.insert(position, found);
            while let Some(found) = early.remove(&awaited) {
                done(&work[awaited], found);
                awaited += 1;
            }
        }
    });
}

#[cfg(test)]
mod tests {
    use super::in_order;

    #[test]
    fn answers_come_in_order() {
        for count in [0, 1, 2, 3, 100] {
            let work: Vec<u64> = (0..count).collect();
            let mut seen = Vec::new();
            // The first inputs take longest.
            let slow = |&n: &u64| (0..(count - n) * 100).fold(n, |a, b| a.wrapping_mul(31) ^ b);
            in_order(&work, |n| (*n, slow(n)), |n, (same, _)| seen.push((*n, same)));
            assert_eq!(seen, work.iter().map(|&n| (n, n)).collect::<Vec<_>>());
        }
    }
}
