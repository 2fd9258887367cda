//! The result of a search.

use crate::ground::Feature;
use crate::ids::OperatorId;
use crate::query::Limit;
use crate::task::{Impossible, Task};

/// A sequence of operators that reaches the goal.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Plan {
    /// The steps.
    pub operators: Vec<OperatorId>,
    /// The sum of their costs in units of `1 / Task::cost_scale`.
    pub cost: u64,
}

impl Plan {
    pub(crate) fn of(task: &Task, operators: Vec<OperatorId>) -> Self {
        let cost = operators.iter().map(|&o| u64::from(task.operators().cost(o))).sum();
        Self { operators, cost }
    }
}

/// Why there is no plan.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum UnsolvableReason {
    /// Parts of the goal that can never hold, even if no fact were ever deleted.
    Impossible(Impossible),
    /// Every reachable state was visited.
    SpaceExhausted,
}

/// The result of a query.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Outcome {
    /// A plan.
    Solved(Plan),
    /// Proof that no plan exists.
    Unsolvable(UnsolvableReason),
    /// No answer within the budget.
    LimitReached(Limit),
    /// The configuration does not support this feature of the task.
    Unsupported(Feature),
}

/// Counts of the work of a search.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Statistics {
    /// States whose successors were generated.
    pub expanded: u64,
    /// States that were estimated.
    pub evaluated: u64,
    /// Successors generated.
    pub generated: u64,
}

impl std::ops::Add for Statistics {
    type Output = Self;

    fn add(mut self, other: Self) -> Self {
        self += other;
        self
    }
}

impl std::ops::AddAssign for Statistics {
    fn add_assign(&mut self, other: Self) {
        self.expanded += other.expanded;
        self.evaluated += other.evaluated;
        self.generated += other.generated;
    }
}

/// The outcome with its statistics.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Report {
    /// The outcome.
    pub outcome: Outcome,
    /// The work that it took.
    pub statistics: Statistics,
}

impl Report {
    pub(crate) fn unsolvable(reason: UnsolvableReason) -> Self {
        Self { outcome: Outcome::Unsolvable(reason), statistics: Statistics::default() }
    }
}
