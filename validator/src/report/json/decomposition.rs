//! A decomposition as JSON.

use crate::report::subject::Subject;
use pddl::{HierarchicalPlan, PlanNode, PlanReference};
use serde::Serialize;

/// A decomposition: the numbers of the root's subtasks, and each task. Actions are numbered from 0,
/// in their order.
#[derive(Serialize)]
pub(super) struct DecompositionRecord {
    root: Vec<u64>,
    tasks: Vec<TaskRecord>,
}

#[derive(Serialize)]
struct TaskRecord {
    id: u64,
    task: String,
    method: Option<String>,
    subtasks: Vec<u64>,
}

impl DecompositionRecord {
    pub(super) fn of(subject: &Subject<'_>, plan: &HierarchicalPlan) -> Self {
        let label = |reference: &PlanReference| match reference.node {
            PlanNode::Step(step) => plan.steps.get(step).map(|step| step.label.0),
            PlanNode::Decomposition(task) => plan.decompositions.get(task).map(|task| task.label.0),
        };
        let labels = |references: &[PlanReference]| references.iter().filter_map(label).collect();
        let tasks = plan.decompositions.enumerate().map(|(id, task)| TaskRecord {
            id: task.label.0,
            task: subject.node(plan, PlanNode::Decomposition(id)),
            method: subject.domain.methods.get(task.method).map(|method| method.name.to_string()),
            subtasks: labels(&task.subtasks),
        });
        Self { root: labels(&plan.roots), tasks: tasks.collect() }
    }
}
