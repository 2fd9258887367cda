//! Checks that the numbers of a hierarchical plan form a tree, and computes the steps of each task.
//!
//! Invariant of a [`Tree`]: each action and task is used exactly once, and everything is below the
//! root. No function recurses, because a plan may be as deep as it is long.

use crate::verdict::{NetworkFault, Parent};
use pddl::model::{Idx, IndexVec};
use pddl::{DecompositionId, HierarchicalPlan, PlanNode, PlanReference, Span};

/// The range from a task's first step to just after its last; empty if it has no steps.
#[derive(Clone, Copy, Debug)]
pub(super) struct Range {
    pub(super) first: u32,
    pub(super) end: u32,
}

impl Range {
    const EMPTY: Self = Self { first: u32::MAX, end: 0 };

    fn step(index: usize) -> Self {
        let first = u32::try_from(index).unwrap_or(u32::MAX - 1);
        Self { first, end: first + 1 }
    }

    pub(super) fn is_empty(self) -> bool {
        self.first >= self.end
    }

    fn join(self, other: Self) -> Self {
        Self { first: self.first.min(other.first), end: self.end.max(other.end) }
    }
}

pub(super) struct Tree {
    ranges: IndexVec<DecompositionId, Range>,
}

pub(super) fn references(plan: &HierarchicalPlan, of: Parent) -> &[PlanReference] {
    match of {
        Parent::Root => &plan.roots,
        Parent::Task(task) => &plan.decompositions[task].subtasks,
    }
}

impl Tree {
    pub(super) fn new(plan: &HierarchicalPlan) -> Result<Self, NetworkFault> {
        let order = children_first(plan)?;
        each_is_used_once(plan)?;
        let mut ranges: IndexVec<_, _> = plan.decompositions.iter().map(|_| Range::EMPTY).collect();
        for task in order {
            let mut range = Range::EMPTY;
            for reference in &plan.decompositions[task].subtasks {
                range = range.join(match reference.node {
                    PlanNode::Step(step) => Range::step(step.index()),
                    PlanNode::Decomposition(below) => ranges[below],
                });
            }
            ranges[task] = range;
        }
        Ok(Self { ranges })
    }

    pub(super) fn range(&self, node: PlanNode) -> Range {
        match node {
            PlanNode::Step(step) => Range::step(step.index()),
            PlanNode::Decomposition(task) => self.ranges[task],
        }
    }
}

/// The tasks in post-order: each comes after its subtasks.
fn children_first(plan: &HierarchicalPlan) -> Result<Vec<DecompositionId>, NetworkFault> {
    #[derive(Clone, Copy, PartialEq)]
    enum Mark {
        New,
        Open,
        Done,
    }
    let mut marks: IndexVec<DecompositionId, Mark> = plan.decompositions.iter().map(|_| Mark::New).collect();
    let mut order = Vec::with_capacity(marks.len());
    for start in plan.decompositions.ids() {
        let mut way = vec![(start, 0)];
        if marks[start] != Mark::New {
            continue;
        }
        marks[start] = Mark::Open;
        while let Some((task, next)) = way.last_mut() {
            let Some(reference) = plan.decompositions[*task].subtasks.get(*next) else {
                marks[*task] = Mark::Done;
                order.push(*task);
                way.pop();
                continue;
            };
            *next += 1;
            let PlanNode::Decomposition(below) = reference.node else { continue };
            match marks.get(below) {
                Some(Mark::New) => {
                    marks[below] = Mark::Open;
                    way.push((below, 0));
                }
                Some(Mark::Open) => return Err(NetworkFault::Cycle { task: below, span: reference.span }),
                Some(Mark::Done) => {}
                None => return Err(NetworkFault::Orphan { node: reference.node }),
            }
        }
    }
    Ok(order)
}

fn each_is_used_once(plan: &HierarchicalPlan) -> Result<(), NetworkFault> {
    let mut steps: Vec<Option<Span>> = vec![None; plan.steps.len()];
    let mut tasks: Vec<Option<Span>> = vec![None; plan.decompositions.len()];
    let parents = std::iter::once(Parent::Root).chain(plan.decompositions.ids().map(Parent::Task));
    for reference in parents.flat_map(|parent| references(plan, parent)) {
        let node = reference.node;
        let used = match node {
            PlanNode::Step(step) => steps.get_mut(step.index()),
            PlanNode::Decomposition(task) => tasks.get_mut(task.index()),
        };
        let used = used.ok_or(NetworkFault::Orphan { node })?;
        if let Some(first) = used.replace(reference.span) {
            return Err(NetworkFault::Shared { node, first, second: reference.span });
        }
    }
    let step = plan.steps.ids().find(|step| steps[step.index()].is_none()).map(PlanNode::Step);
    let task = || plan.decompositions.ids().find(|task| tasks[task.index()].is_none());
    match step.or_else(|| task().map(PlanNode::Decomposition)) {
        Some(node) => Err(NetworkFault::Orphan { node }),
        None => Ok(()),
    }
}
