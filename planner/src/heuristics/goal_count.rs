//! How many literals of the goal do not hold. Neither admissible nor consistent; safe.

use super::{Estimate, Heuristic};
use crate::ids::{OperatorId, StateId, id32};
use crate::task::{Goal, contains};

pub(crate) struct GoalCount<'t> {
    goal: &'t Goal,
}

impl<'t> GoalCount<'t> {
    pub(crate) fn new(goal: &'t Goal) -> Self {
        Self { goal }
    }
}

impl Heuristic for GoalCount<'_> {
    fn estimate(&mut self, _: StateId, words: &[u64], _: &[OperatorId], _: &mut Vec<OperatorId>) -> Estimate {
        Estimate(open_goals(self.goal, words))
    }
}

/// How many literals of the goal do not hold.
pub(crate) fn open_goals(goal: &Goal, words: &[u64]) -> u32 {
    let literals = &goal.literals;
    let missing = literals.positive.iter().filter(|&&f| !contains(words, f)).count();
    id32(missing + literals.negative.iter().filter(|&&f| contains(words, f)).count())
}
