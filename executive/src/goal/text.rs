//! A goal as the mission's text gives it.

use low_to_high::Fact;
use pddl::model::{Condition, Name, Problem, Variables};
use std::time::Duration;

/// The number of a goal, in the order of the mission's text.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, serde::Serialize)]
pub struct GoalId(pub u32);

impl GoalId {
    pub(crate) fn index(self) -> usize {
        self.0 as usize
    }
}

/// A goal of a mission.
#[derive(Clone, Debug)]
pub struct GoalText {
    /// Its name.
    pub name: Name,
    /// What is to hold, over the planning domain and the objects of the problem.
    pub condition: Condition,
    /// The quantified variables of the condition.
    pub variables: Variables,
    /// What it is worth.
    pub importance: Importance,
    /// The perceived fact that makes it wanted; without one it is wanted from the start.
    pub when: Option<Fact>,
    /// The perceived fact under which it waits.
    pub hold: Option<Fact>,
    /// The perceived fact that ends it.
    pub drop: Option<Fact>,
    /// How long it may be wanted before it is given up.
    pub deadline: Option<Duration>,
    /// Whether it interrupts the step that is under way, instead of waiting for its end.
    pub urgent: bool,
    /// Whether it is wanted again whenever its condition does not hold.
    pub maintained: bool,
}

/// What a goal is worth.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Importance {
    /// It must be achieved; the higher number goes first, and goals of one number go together.
    Hard(i64),
    /// A plan may go without it, at this price.
    Soft(f64),
}

impl GoalText {
    /// The goal of a problem that must be achieved, with the name of the problem.
    pub fn of_problem(problem: &Problem) -> Self {
        let (condition, variables) = (problem.goal.clone(), problem.goal_variables.clone());
        Self::hard(problem.name.clone(), condition, variables)
    }

    /// A goal that is wanted from the start and must be achieved.
    pub fn hard(name: Name, condition: Condition, variables: Variables) -> Self {
        Self {
            name,
            condition,
            variables,
            importance: Importance::Hard(0),
            when: None,
            hold: None,
            drop: None,
            deadline: None,
            urgent: false,
            maintained: false,
        }
    }

    /// Whether it is about objects that it does not name.
    pub(crate) fn is_quantified(&self) -> bool {
        !self.variables.slots.is_empty()
    }

    /// Its priority; `None` for a soft goal.
    pub fn priority(&self) -> Option<i64> {
        match self.importance {
            Importance::Hard(priority) => Some(priority),
            Importance::Soft(_) => None,
        }
    }

    /// Whether it may become wanted again after its end.
    pub fn recurs(&self) -> bool {
        self.when.is_some() || self.maintained
    }
}
