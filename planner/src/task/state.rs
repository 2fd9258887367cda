//! States as bit sets over facts.
//!
//! If a task has numbers, they follow the facts in separate words (`numeric`).
//!
//! Idea: one bit per fact, 64 to a word, so a literal of either sign is one test, and copying a
//! state is a `memcpy`. The free functions work on borrowed words, because a search keeps its
//! states in one arena.

use crate::ids::{FactId, id32};

/// A state with its own storage.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct State {
    words: Box<[u64]>,
    /// The number of words that hold facts.
    facts: usize,
    /// Whether a number did not fit and is missing.
    lost: bool,
}

impl State {
    /// A state with this many facts and this many words of numbers.
    pub(crate) fn empty(facts: usize, numbers: usize) -> Self {
        let facts = facts.div_ceil(64);
        Self { words: vec![0; facts + numbers].into_boxed_slice(), facts, lost: false }
    }

    /// Whether the fact holds.
    pub fn contains(&self, fact: FactId) -> bool {
        contains(&self.words, fact)
    }

    /// The facts that hold, in order of their ids.
    pub fn facts(&self) -> Vec<FactId> {
        let mut facts = Vec::new();
        for_each_set(&self.words[..self.facts], |f| facts.push(FactId(f)));
        facts
    }

    /// Whether the state holds all numbers that it was given. From a state that lacks one, nothing
    /// can be proven impossible.
    pub(crate) fn is_exact(&self) -> bool {
        !self.lost
    }

    /// Records whether the last numbers that were written fit.
    pub(crate) fn note_fit(&mut self, fit: bool) {
        self.lost |= !fit;
    }

    pub(crate) fn insert(&mut self, fact: FactId) {
        set(&mut self.words, fact);
    }

    pub(crate) fn words(&self) -> &[u64] {
        &self.words
    }

    pub(crate) fn words_mut(&mut self) -> &mut [u64] {
        &mut self.words
    }
}

pub(crate) fn contains(words: &[u64], fact: FactId) -> bool {
    words[fact.0 as usize / 64] >> (fact.0 % 64) & 1 == 1
}

pub(crate) fn set(words: &mut [u64], fact: FactId) {
    words[fact.0 as usize / 64] |= 1 << (fact.0 % 64);
}

pub(crate) fn unset(words: &mut [u64], fact: FactId) {
    words[fact.0 as usize / 64] &= !(1 << (fact.0 % 64));
}

/// Calls `f` with each set bit, in ascending order.
pub(crate) fn for_each_set(words: &[u64], mut f: impl FnMut(u32)) {
    for (i, &word) in words.iter().enumerate() {
        let mut rest = word;
        while rest != 0 {
            f(id32(i) * 64 + rest.trailing_zeros());
            rest &= rest - 1;
        }
    }
}
