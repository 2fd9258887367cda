//! Work on all cores, answers in order.
//!
//! Invariant: `done` is called once per piece of work, in the order of the work, as soon as that and all before it are
//! done. Answers that come early wait.

use std::collections::BTreeMap;
use std::num::NonZero;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::mpsc;

/// How many pieces of work are done at once.
pub(crate) fn width() -> usize {
    std::thread::available_parallelism().map_or(1, NonZero::get)
}

/// Does all the work.
pub(crate) fn in_order<W: Sync, A: Send>(
    work: &[W],
    answer: impl Fn(&W) -> A + Sync,
    mut done: impl FnMut(&W, A),
) {
    if let [piece] = work {
        done(piece, answer(piece));
        return;
    }
    let next = AtomicUsize::new(0);
    let (send, receive) = mpsc::channel();
    std::thread::scope(|scope| {
        for _ in 0..width().min(work.len()) {
            let (send, next, answer) = (send.clone(), &next, &answer);
            scope.spawn(move || {
                loop {
                    let position = next.fetch_add(1, Ordering::Relaxed);
                    let Some(piece) = work.get(position) else { break };
                    if send.send((position, answer(piece))).is_err() {
                        break;
                    }
                }
            });
        }
        drop(send);
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
            // The first pieces take longest.
            let slow = |&n: &u64| (0..(count - n) * 100).fold(n, |a, b| a.wrapping_mul(31) ^ b);
            in_order(&work, |n| (*n, slow(n)), |n, (same, _)| seen.push((*n, same)));
            assert_eq!(seen, work.iter().map(|&n| (n, n)).collect::<Vec<_>>());
        }
    }
}
