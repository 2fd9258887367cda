//! Why a task has no plan; the planner provides the words, [`super::record`] the data.

use planner::{Budget, Explanation, Query, Task, UnsolvableReason, Wording, explain};

/// The explanation of an unsolvable task, with the task for its names.
pub(crate) struct Unsolvable<'a> {
    pub(super) task: &'a Task,
    pub(super) explanation: Explanation,
}

impl<'a> Unsolvable<'a> {
    /// Explains why the task has no plan; `budget` bounds the search for reasons.
    pub(crate) fn of(
        domain: &pddl::model::Domain,
        problem: &pddl::model::Problem,
        task: &'a Task,
        reason: &UnsolvableReason,
        budget: &Budget<'_>,
    ) -> Self {
        Self { task, explanation: explain(domain, problem, task, &Query::of(task), reason, budget) }
    }

    /// The explanation in words.
    pub(crate) fn words(&self) -> Wording<'_> {
        Wording::new(self.task, &self.explanation)
    }
}
