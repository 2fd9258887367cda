//! Recent happenings, and those that interfere with a new one.
//!
//! Problem: ten thousand actions that start at one time are fifty million pairs. Idea: recent happenings are listed
//! by the atoms and fluents that they read and change, and a new one looks up its own. Invariant: each list holds the
//! remembered happenings in their order, possibly after some forgotten ones.
//!
//! Cost: the size of a footprint, independent of the number of happenings.

use super::footprint::{Footprint, Touch};
use crate::cause::Cause;
use crate::number::Number;
use crate::verdict::Shared;
use rustc_hash::FxHashMap;
use std::collections::VecDeque;

#[derive(Debug)]
struct Recent {
    time: Number,
    what: Cause,
    footprint: Footprint,
}

/// The recent happenings, oldest first.
#[derive(Debug, Default)]
pub(super) struct Concurrent {
    recent: VecDeque<Recent>,
    /// The number of forgotten happenings.
    forgotten: usize,
    /// By access: the numbers of the happenings that make it.
    by_touch: FxHashMap<Touch, VecDeque<usize>>,
}

impl Concurrent {
    /// Forgets the happenings that are at least `separation` before `now`.
    pub(super) fn forget(&mut self, now: Number, separation: Number) {
        while let Some(oldest) = self.recent.front() {
            if now.minus(oldest.time).is_ok_and(|age| age < separation) {
                return;
            }
            self.recent.pop_front();
            self.forgotten += 1;
        }
        if self.recent.is_empty() {
            self.by_touch.clear();
        }
    }

    /// The first happening that interferes, and what both access.
    pub(super) fn in_the_way(&mut self, footprint: &Footprint) -> Option<(Cause, Shared)> {
        let (forgotten, by_touch) = (self.forgotten, &mut self.by_touch);
        let mut first: Option<usize> = None;
        footprint.each_touch(&mut |touch| {
            touch.each_rival(&mut |rival| {
                let Some(numbers) = by_touch.get_mut(&rival) else { return };
                while numbers.front().is_some_and(|&number| number < forgotten) {
                    numbers.pop_front();
                }
                if let Some(&number) = numbers.front() {
                    first = Some(first.map_or(number, |first| first.min(number)));
                }
            });
        });
        let recent = self.recent.get(first? - forgotten)?;
        Some((recent.what, recent.footprint.interference(footprint)?))
    }

    /// Remembers a happening.
    pub(super) fn push(&mut self, time: Number, what: Cause, footprint: Footprint) {
        let number = self.forgotten + self.recent.len();
        footprint.each_touch(&mut |touch| {
            let numbers = self.by_touch.entry(touch).or_default();
            if numbers.back() != Some(&number) {
                numbers.push_back(number);
            }
        });
        self.recent.push_back(Recent { time, what, footprint });
    }
}
