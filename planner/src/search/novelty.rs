//! Novelty: does a state hold some fact, or some pair of facts, that no earlier state of its class has
//! held together?
//!
//! Idea: a bit set of the facts seen for each class; for pairs, such a set for each fact, so that a
//! test is as many word operations as the state has words, times its facts. Rows are made when a fact
//! is first seen. Beyond the bytes allowed for pairs, no pair counts as new.
//!
//! Source: Lipovetzky & Geffner, "Width and serialization of classical planning problems", ECAI 2012;
//! classes: the same, "Best-first width search", AAAI 2017.

use crate::task::for_each_set;
use rustc_hash::FxHashMap;

/// The size of the smallest set of facts that is new.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Novelty {
    One,
    Two,
    Larger,
}

/// The facts and pairs that one class of states has shown.
struct Class {
    facts: Box<[u64]>,
    /// By fact, the facts seen with it.
    rows: Vec<Option<Box<[u64]>>>,
}

/// What all classes have shown.
pub(crate) struct NoveltyTable {
    words: usize,
    pairs: bool,
    most_bytes: usize,
    classes: FxHashMap<(u32, u32), Class>,
    bytes: usize,
}

impl NoveltyTable {
    /// Tells facts only.
    pub(crate) fn of_facts(words: usize) -> Self {
        Self { words, pairs: false, most_bytes: 0, classes: FxHashMap::default(), bytes: 0 }
    }

    /// Tells facts and pairs of facts, within so many bytes.
    pub(crate) fn of_pairs(words: usize, most_bytes: usize) -> Self {
        Self { pairs: true, most_bytes, ..Self::of_facts(words) }
    }

    /// Judges a state and remembers it.
    pub(crate) fn judge(&mut self, class: (u32, u32), state: &[u64]) -> Novelty {
        let words = self.words;
        let entry = self.classes.entry(class).or_insert_with(|| {
            self.bytes += words * 8 + 96;
            Class { facts: vec![0; words].into_boxed_slice(), rows: Vec::new() }
        });
        let mut novelty = match merge(&mut entry.facts, state) {
            true => Novelty::One,
            false => Novelty::Larger,
        };
        if !self.pairs || self.bytes > self.most_bytes {
            return novelty;
        }
        if entry.rows.is_empty() {
            entry.rows.resize_with(words * 64, || None);
            self.bytes += words * 64 * size_of::<Option<Box<[u64]>>>();
        }
        let mut new = false;
        for_each_set(state, |fact| {
            let row = entry.rows[fact as usize].get_or_insert_with(|| {
                self.bytes += words * 8 + 16;
                vec![0; words].into_boxed_slice()
            });
            new |= merge(row, state);
        });
        if new && novelty == Novelty::Larger {
            novelty = Novelty::Two;
        }
        novelty
    }

    /// Units of work that a judgement takes.
    pub(crate) fn price(&self) -> usize {
        if self.pairs { self.words * self.words * 8 } else { self.words * 4 + 32 }
    }

    pub(crate) fn memory(&self) -> usize {
        self.bytes
    }
}

/// Adds the bits of `state`. Answers whether some were new.
fn merge(seen: &mut [u64], state: &[u64]) -> bool {
    let mut new = 0;
    for (seen, &word) in seen.iter_mut().zip(state) {
        new |= word & !*seen;
        *seen |= word;
    }
    new != 0
}

#[cfg(test)]
mod tests {
    use super::{Novelty, NoveltyTable};

    #[test]
    fn facts_then_pairs_then_nothing_is_new() {
        let mut table = NoveltyTable::of_pairs(1, usize::MAX);
        assert_eq!(table.judge((0, 0), &[0b0011]), Novelty::One);
        assert_eq!(table.judge((0, 0), &[0b1100]), Novelty::One);
        assert_eq!(table.judge((0, 0), &[0b0110]), Novelty::Two);
        assert_eq!(table.judge((0, 0), &[0b0110]), Novelty::Larger);
        assert_eq!(table.judge((1, 0), &[0b0110]), Novelty::One, "another class");
        let mut bounded = NoveltyTable::of_pairs(1, 0);
        assert_eq!(bounded.judge((0, 0), &[0b0011]), Novelty::One);
        assert_eq!(bounded.judge((0, 0), &[0b0001]), Novelty::Larger);
    }
}
