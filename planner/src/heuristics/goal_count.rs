//! The number of literals of the goal that do not hold. Neither admissible nor consistent; safe.

use super::{Estimate, Heuristic, View};
use crate::ids::{OperatorId, id32};
use crate::task::{Goal, contains};

pub(crate) struct GoalCount<'a> {
    goal: &'a Goal,
}

impl<'a> GoalCount<'a> {
    pub(crate) fn new(goal: &'a Goal) -> Self {
        Self { goal }
    }
}

impl Heuristic for GoalCount<'_> {
    fn estimate(&mut self, view: &View<'_>, _: Option<&mut Vec<OperatorId>>) -> Estimate {
        Estimate(open_goals(self.goal, view.words))
    }
}

/// The number of literals of the goal that do not hold.
fn open_goals(goal: &Goal, words: &[u64]) -> u32 {
    let literals = &goal.literals;
    let missing = literals.positive.iter().filter(|&&f| !contains(words, f)).count();
    id32(missing + literals.negative.iter().filter(|&&f| contains(words, f)).count())
}
