//! Recorded histories of operations by several threads, and whether some order of them explains what each saw.
//!
//! An operation began at one tick of a shared clock and ended at another; what ended before another began comes before
//! it. A history is linearisable if the operations can be put in an order that keeps this and in which each gives what
//! it gave. Two ways to tell: a search that knows nothing of versions (every order, cut where it contradicts, with the
//! configurations seen kept), for short histories; and for long ones the order that the versions themselves claim.
//!
//! Source: Wing and Gong, "Testing and verifying concurrent objects", 1993; Lowe, "Testing for linearizability", 2017,
//! for the configurations seen.

use std::collections::HashSet;

/// The numbers that the operations are about.
pub(crate) type Numbers = [u32; 3];

/// What was done and what it gave.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Kind {
    /// All numbers were read.
    Read { saw: Numbers },
    /// One number was changed by another, both having been read: see [`sum`].
    Add { from: usize, to: usize, saw: Numbers },
}

#[derive(Debug, Clone)]
pub(crate) struct Operation {
    pub(crate) began: u64,
    pub(crate) ended: u64,
    /// The version that was read or made.
    pub(crate) version: u64,
    pub(crate) kind: Kind,
}

/// Never the number that was there, and another for almost any other numbers.
pub(crate) fn sum(numbers: Numbers, from: usize, to: usize) -> u32 {
    (numbers[to] + 1 + numbers[from] % 7) % 1_000
}

/// The numbers after an operation, if it could give what it gave when they were these.
fn step(numbers: Numbers, kind: &Kind) -> Option<Numbers> {
    match *kind {
        Kind::Read { saw } => (saw == numbers).then_some(numbers),
        Kind::Add { from, to, saw } => {
            let mut next = numbers;
            next[to] = sum(numbers, from, to);
            (saw == numbers).then_some(next)
        }
    }
}

/// Whether any order explains the history: at most 64 operations.
pub(crate) fn some_order(start: Numbers, history: &[Operation]) -> bool {
    assert!(history.len() <= 64, "a set of operations is one word");
    fn search(
        done: u64,
        numbers: Numbers,
        history: &[Operation],
        seen: &mut HashSet<(u64, Numbers)>,
    ) -> bool {
        let open = || history.iter().enumerate().filter(|(at, _)| done >> at & 1 == 0);
        let Some(first_end) = open().map(|(_, op)| op.ended).min() else { return true };
        if !seen.insert((done, numbers)) {
            return false;
        }
        // Only what began before every open operation ended may come next.
        open().filter(|(_, op)| op.began < first_end).any(|(at, op)| {
            step(numbers, &op.kind).is_some_and(|next| search(done | 1 << at, next, history, seen))
        })
    }
    search(0, start, history, &mut HashSet::new())
}

/// Whether the order of versions explains the history; says what contradicts.
pub(crate) fn order_of_versions(start: Numbers, history: &[Operation]) -> Result<(), String> {
    let mut order: Vec<_> = history.iter().collect();
    // Those who read a version come after the one that made it.
    order.sort_by_key(|op| (op.version, matches!(op.kind, Kind::Read { .. }), op.began));
    let (mut numbers, mut made, mut last_began) = (start, None, 0);
    for op in &order {
        if let Kind::Add { .. } = op.kind
            && made.replace(op.version) == Some(op.version)
        {
            return Err(format!("version {} was made twice", op.version));
        }
        numbers = step(numbers, &op.kind).ok_or(format!("{op:?} cannot be where {numbers:?} is"))?;
    }
    // Nothing ended before something began that its version puts before it.
    for op in &order {
        if op.ended < last_began {
            return Err(format!("{op:?} ended before something began that comes before it"));
        }
        last_began = last_began.max(op.began);
    }
    Ok(())
}
