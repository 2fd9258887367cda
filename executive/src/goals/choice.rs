//! Which of the wanted goals one plan serves, and in which order.
//!
//! Problem: several goals are wanted; together they may have no plan, and the most important one must not wait for the
//! others. Idea: go through the levels of priority from the highest. The goals of a level are one conjunction, so the
//! planner interleaves what serves them. What serves a lower level comes after that, and keeps what the higher levels have
//! reached. Where the goals of a level do not go together, they are added one by one, each only if all served so far can
//! still be reached with it; where it cannot be reached after the higher ones, it may still be reached with them. A goal
//! that is left out is postponed, with the reason. Invariant: the end of the plan satisfies all goals that it serves.
//! Cost: a search for each level, and one or two more for each goal of a level that has no plan as a whole.

use crate::goal::GoalId;
use crate::outcome::NoPlan;
use planner::OperatorId;
use serde::Serialize;

/// A part of a plan, and the goals that it serves.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Stage {
    /// The goals.
    pub goals: Vec<GoalId>,
    /// The number of steps up to its end, those of the stages before included.
    pub end: usize,
}

/// A plan for some of the goals.
#[derive(Clone, Debug, Default)]
pub(crate) struct Choice {
    pub(crate) operators: Vec<OperatorId>,
    pub(crate) stages: Vec<Stage>,
    /// The goals that it does not serve, and why.
    pub(crate) postponed: Vec<(GoalId, NoPlan)>,
}

impl Choice {
    /// The goals that it serves.
    pub(crate) fn served(&self) -> Vec<GoalId> {
        self.stages.iter().flat_map(|stage| stage.goals.iter().copied()).collect()
    }

    fn extend(&mut self, goals: Vec<GoalId>, more: Vec<OperatorId>) {
        self.operators.extend(more);
        self.stages.push(Stage { goals, end: self.operators.len() });
    }
}

/// What is to be reached.
pub(crate) struct Aim<'a> {
    /// The steps that come first.
    pub(crate) after: &'a [OperatorId],
    /// All goals that must hold in the end.
    pub(crate) all: &'a [GoalId],
    /// Those of them that this part is made for.
    pub(crate) fresh: &'a [GoalId],
}

/// Chooses among goals in levels, the highest first. `plan` finds the steps after those that come first.
pub(crate) fn choose(
    levels: &[Vec<GoalId>],
    mut plan: impl FnMut(Aim<'_>) -> Result<Vec<OperatorId>, Box<NoPlan>>,
) -> Choice {
    let mut choice = Choice::default();
    for level in levels {
        let all = [choice.served(), level.clone()].concat();
        match plan(Aim { after: &choice.operators, all: &all, fresh: level }) {
            Ok(more) => choice.extend(level.clone(), more),
            Err(why) => match level.as_slice() {
                &[goal] => together(&mut choice, goal, why, &mut plan),
                _ => level.iter().for_each(|&goal| add(&mut choice, goal, &mut plan)),
            },
        }
    }
    choice
}

/// Adds one goal behind what is served already.
fn add(
    choice: &mut Choice,
    goal: GoalId,
    plan: &mut impl FnMut(Aim<'_>) -> Result<Vec<OperatorId>, Box<NoPlan>>,
) {
    let all = [choice.served(), vec![goal]].concat();
    match plan(Aim { after: &choice.operators, all: &all, fresh: &[goal] }) {
        Ok(more) => choice.extend(vec![goal], more),
        Err(why) => together(choice, goal, why, plan),
    }
}

/// A goal cannot be reached behind the others: with them perhaps.
fn together(
    choice: &mut Choice,
    goal: GoalId,
    why: Box<NoPlan>,
    plan: &mut impl FnMut(Aim<'_>) -> Result<Vec<OperatorId>, Box<NoPlan>>,
) {
    if choice.stages.is_empty() {
        return choice.postponed.push((goal, *why));
    }
    let all = [choice.served(), vec![goal]].concat();
    match plan(Aim { after: &[], all: &all, fresh: &all }) {
        Ok(operators) => {
            let end = operators.len();
            choice.operators = operators;
            choice.stages = vec![Stage { goals: all, end }];
        }
        Err(why) => choice.postponed.push((goal, *why)),
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test")]
mod tests {
    use super::{Aim, choose};
    use crate::goal::GoalId;
    use crate::outcome::NoPlan;
    use planner::OperatorId;

    /// A goal is reached by the step of its number; `clash` do not go together, `first` must come before all others.
    fn plans(
        clash: &'static [u32],
        first: Option<u32>,
    ) -> impl FnMut(Aim<'_>) -> Result<Vec<OperatorId>, Box<NoPlan>> {
        move |aim| {
            let late = first.is_some_and(|first| aim.fresh.contains(&GoalId(first)) && !aim.after.is_empty());
            if late || aim.all.iter().filter(|goal| clash.contains(&goal.0)).count() > 1 {
                return Err(Box::new(NoPlan::LimitReached(7)));
            }
            Ok(aim.fresh.iter().rev().map(|goal| OperatorId(goal.0)).collect())
        }
    }

    fn story(
        levels: &[&[u32]],
        plan: impl FnMut(Aim<'_>) -> Result<Vec<OperatorId>, Box<NoPlan>>,
    ) -> (Vec<(Vec<u32>, usize)>, Vec<u32>) {
        let levels: Vec<Vec<GoalId>> =
            levels.iter().map(|level| level.iter().map(|&g| GoalId(g)).collect()).collect();
        let choice = choose(&levels, plan);
        let stages = choice.stages.iter().map(|s| (s.goals.iter().map(|g| g.0).collect(), s.end)).collect();
        (stages, choice.postponed.iter().map(|(goal, _)| goal.0).collect())
    }

    #[test]
    fn goals_of_a_level_go_together_and_levels_one_after_the_other() {
        let (stages, postponed) = story(&[&[2], &[0, 1]], plans(&[], None));
        assert_eq!(stages, [(vec![2], 1), (vec![0, 1], 3)]);
        assert!(postponed.is_empty());
    }

    #[test]
    fn what_does_not_go_with_the_more_important_goals_is_postponed() {
        let (stages, postponed) = story(&[&[2], &[0, 1]], plans(&[2, 0], None));
        assert_eq!(stages, [(vec![2], 1), (vec![1], 2)]);
        assert_eq!(postponed, [0]);
    }

    #[test]
    fn what_cannot_come_after_the_others_may_still_come_with_them() {
        let (stages, postponed) = story(&[&[2], &[1]], plans(&[], Some(1)));
        assert_eq!(stages, [(vec![2, 1], 2)]);
        assert!(postponed.is_empty());
    }
}
