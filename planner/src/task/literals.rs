//! Conjunctions of ground literals.

use super::state::contains;
use crate::ids::FactId;

/// A conjunction of ground literals.
#[derive(Clone, Debug, Default, PartialEq, Eq, Hash)]
pub struct Literals {
    /// Facts that must hold, sorted.
    pub positive: Box<[FactId]>,
    /// Facts that must not hold, sorted.
    pub negative: Box<[FactId]>,
}

impl Literals {
    pub(crate) fn hold_in(&self, words: &[u64]) -> bool {
        self.as_ref().hold_in(words)
    }

    /// The number of literals.
    pub fn len(&self) -> usize {
        self.as_ref().len()
    }

    /// Whether it holds everywhere.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// The same literals, borrowed.
    pub fn as_ref(&self) -> LiteralsRef<'_> {
        LiteralsRef { positive: &self.positive, negative: &self.negative }
    }
}

/// A borrowed conjunction.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct LiteralsRef<'a> {
    /// Facts that must hold, sorted.
    pub positive: &'a [FactId],
    /// Facts that must not hold, sorted.
    pub negative: &'a [FactId],
}

impl<'a> LiteralsRef<'a> {
    /// Each fact with whether it must hold.
    pub fn iter(self) -> impl Iterator<Item = (FactId, bool)> + Clone + use<'a> {
        let positive = self.positive.iter().map(|&fact| (fact, true));
        positive.chain(self.negative.iter().map(|&fact| (fact, false)))
    }

    pub(crate) fn hold_in(self, words: &[u64]) -> bool {
        self.positive.iter().all(|&f| contains(words, f))
            && self.negative.iter().all(|&f| !contains(words, f))
    }

    /// The number of literals.
    pub fn len(self) -> usize {
        self.positive.len() + self.negative.len()
    }

    /// Whether it holds everywhere.
    pub fn is_empty(self) -> bool {
        self.len() == 0
    }
}
