//! Novelty: does a state hold a fact, or a pair of facts, that no earlier state of its class has
//! held?
//!
//! Idea: a bit set of the facts seen for each class. For pairs there is such a set for each fact,
//! so a test costs one word operation for each fact and each word of the state. If the parent is in
//! the same class, only pairs with a fact that the step added can be new, and only those are
//! tested. A row is allocated when its fact is first seen. When the bytes allowed for pairs are
//! used up, no pair counts as new. Invariant: the row of `a` holds `b` if and only if the row of
//! `b` holds `a`.
//!
//! Source: Lipovetzky & Geffner, "Width and serialization of classical planning problems", ECAI 2012;
//! classes: the same, "Best-first width search", AAAI 2017.

use crate::ids::id32;
use crate::task::for_each_set;
use rustc_hash::FxHashMap;

/// The size of the smallest set of facts that is new.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Novelty {
    One,
    Two,
    Larger,
}

/// The facts and pairs that the states of one class have held.
struct Class {
    facts: Box<[u64]>,
    /// By fact: the facts seen together with it.
    rows: Vec<Option<Box<[u64]>>>,
    rows_made: usize,
}

impl Class {
    /// Adds all pairs of the state. Returns whether some pair was new.
    fn add_all_pairs(&mut self, state: &[u64]) -> bool {
        let mut new = false;
        for_each_set(state, |fact| new |= merge(self.row(fact, state.len()), state));
        new
    }

    /// The same, if every pair of facts of `from` is known.
    fn add_pairs(&mut self, state: &[u64], from: &[u64]) -> bool {
        let mut new = false;
        for (word, (&now, &then)) in state.iter().zip(from).enumerate() {
            for_each_set(&[now & !then], |bit| {
                let fact = id32(word * 64) + bit;
                let mut row = std::mem::take(self.row(fact, state.len()));
                for (other, (seen, &now)) in row.iter_mut().zip(state).enumerate() {
                    let fresh = now & !*seen;
                    if fresh != 0 {
                        new = true;
                        *seen |= now;
                        for_each_set(&[fresh], |bit| {
                            let other = id32(other * 64) + bit;
                            if other != fact {
                                self.row(other, state.len())[word] |= 1 << (fact % 64);
                            }
                        });
                    }
                }
                *self.row(fact, state.len()) = row;
            });
        }
        new
    }

    fn row(&mut self, fact: u32, words: usize) -> &mut Box<[u64]> {
        let made = &mut self.rows_made;
        self.rows[fact as usize].get_or_insert_with(|| {
            *made += 1;
            vec![0; words].into_boxed_slice()
        })
    }
}

/// The facts and pairs that the states of all classes have held.
pub(crate) struct NoveltyTable {
    words: usize,
    pairs: bool,
    most_bytes: usize,
    classes: FxHashMap<(u32, u32), Class>,
    bytes: usize,
}

impl NoveltyTable {
    /// A table for single facts.
    pub(crate) fn of_facts(words: usize) -> Self {
        Self { words, pairs: false, most_bytes: 0, classes: FxHashMap::default(), bytes: 0 }
    }

    /// A table for facts and pairs of facts, within this many bytes.
    pub(crate) fn of_pairs(words: usize, most_bytes: usize) -> Self {
        Self { pairs: true, most_bytes, ..Self::of_facts(words) }
    }

    /// Returns the novelty of a state and remembers its facts. `from` is the parent state, if it
    /// was judged in the same class.
    pub(crate) fn judge(&mut self, class: (u32, u32), state: &[u64], from: Option<&[u64]>) -> Novelty {
        let (words, pairs) = (self.words, self.tells_pairs());
        let entry = self.classes.entry(class).or_insert_with(|| {
            self.bytes += words * 8 + 96;
            Class { facts: vec![0; words].into_boxed_slice(), rows: Vec::new(), rows_made: 0 }
        });
        let mut novelty = match merge(&mut entry.facts, state) {
            true => Novelty::One,
            false => Novelty::Larger,
        };
        if !pairs {
            return novelty;
        }
        if entry.rows.is_empty() {
            entry.rows.resize_with(words * 64, || None);
            self.bytes += words * 64 * size_of::<Option<Box<[u64]>>>();
        }
        let before = entry.rows_made;
        let new = match from {
            None => entry.add_all_pairs(state),
            Some(from) => entry.add_pairs(state, from),
        };
        self.bytes += (entry.rows_made - before) * (words * 8 + 16);
        if new && novelty == Novelty::Larger {
            novelty = Novelty::Two;
        }
        novelty
    }

    /// Whether pairs are tested and there is memory left for them.
    fn tells_pairs(&self) -> bool {
        self.pairs && self.bytes <= self.most_bytes
    }

    /// The units of work that the next call of `judge` takes.
    pub(crate) fn price(&self, from: Option<&[u64]>) -> usize {
        match (self.tells_pairs(), from) {
            (false, _) => self.words * 4 + 32,
            (true, Some(_)) => self.words * 16 + 128,
            (true, None) => self.words * self.words * 8,
        }
    }

    pub(crate) fn memory(&self) -> usize {
        self.bytes
    }
}

/// Adds the bits of `state`. Returns whether some were new.
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
    use proptest::prelude::*;

    #[test]
    fn facts_then_pairs_then_nothing_is_new() {
        let mut table = NoveltyTable::of_pairs(1, usize::MAX);
        assert_eq!(table.judge((0, 0), &[0b0011], None), Novelty::One);
        assert_eq!(table.judge((0, 0), &[0b1100], None), Novelty::One);
        assert_eq!(table.judge((0, 0), &[0b0110], None), Novelty::Two);
        assert_eq!(table.judge((0, 0), &[0b0110], None), Novelty::Larger);
        assert_eq!(table.judge((1, 0), &[0b0110], None), Novelty::One, "another class");
        let mut bounded = NoveltyTable::of_pairs(1, 0);
        assert_eq!(bounded.judge((0, 0), &[0b0011], None), Novelty::One);
        assert_eq!(bounded.judge((0, 0), &[0b0001], None), Novelty::Larger);
    }

    proptest! {
        #[test]
        fn steps_are_judged_as_states_are(
            steps in prop::collection::vec((any::<prop::sample::Index>(), 0..130_u32, 0..130_u32), 1..60)
        ) {
            let (mut whole, mut stepwise) =
                (NoveltyTable::of_pairs(3, usize::MAX), NoveltyTable::of_pairs(3, usize::MAX));
            let mut states: Vec<[u64; 3]> = vec![[0b1011, 0b1, 0]];
            whole.judge((0, 0), &states[0], None);
            stepwise.judge((0, 0), &states[0], None);
            for (from, add, delete) in steps {
                let from = *from.get(&states);
                let mut next = from;
                next[delete as usize / 64] &= !(1 << (delete % 64));
                next[add as usize / 64] |= 1 << (add % 64);
                let expected = whole.judge((0, 0), &next, None);
                prop_assert_eq!(stepwise.judge((0, 0), &next, Some(&from)), expected);
                states.push(next);
            }
        }
    }
}
