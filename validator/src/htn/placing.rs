//! The moments at which the preconditions of methods hold.
//!
//! A method's precondition acts like that of an action without effects, before all subtasks of the method and after
//! the predecessors of its task. In a total order that is one moment. Else some moment must do, and taking the
//! earliest never hurts another task. So one walk over the tree, in the order of the networks, either places all
//! preconditions or finds one that has no place. The walk does not recurse.
//!
//! Source: Höller et al., "HDDL: an extension to PDDL for expressing hierarchical planning problems", AAAI 2020, §3:
//! preconditions of methods are compiled to actions.

use super::schema::Schema;
use super::tree::references;
use crate::verdict::Parent;
use pddl::{DecompositionId, HierarchicalPlan, PlanNode};

/// Moments are numbers of steps before them.
pub(super) type Slot = u32;

/// One way to read a task's subtasks.
#[derive(Clone, Debug)]
pub(super) struct Reading {
    /// Per subtask of the network, the position of the plan's.
    pub(super) children: Vec<u32>,
    /// The moments at which the precondition holds, ascending; `None` means all.
    pub(super) holds: Option<Vec<Slot>>,
}

/// The earliest moment of a subtask. `by` is the task whose precondition delays it, with the first
/// moment that was considered.
#[derive(Clone, Copy, Debug)]
struct Bound {
    slot: Slot,
    by: Option<(DecompositionId, Slot)>,
}

impl Bound {
    fn later(self, other: Self) -> Self {
        if other.slot > self.slot { other } else { self }
    }
}

/// A task whose subtasks are being placed.
struct Frame {
    of: Parent,
    next: usize,
    start: Bound,
    /// Per subtask of the network.
    ends: Vec<Bound>,
    /// The index of the task in its parent's network.
    within: u32,
}

/// Places every precondition. Otherwise returns a task whose precondition has no place, with the
/// first moment that was considered.
///
/// Calls `visit` with the earliest moment of each task.
pub(super) fn place<'a>(
    plan: &HierarchicalPlan,
    schema: impl Fn(Parent) -> &'a Schema<'a>,
    reading: impl Fn(Parent) -> &'a Reading,
    mut visit: impl FnMut(DecompositionId, Slot),
) -> Result<(), (DecompositionId, Slot)> {
    let frame = |of, start, within| Frame {
        of,
        next: 0,
        start,
        ends: vec![start; schema(of).network.subtasks.len()],
        within,
    };
    let mut way = vec![frame(Parent::Root, Bound { slot: 0, by: None }, 0)];
    while let Some(top) = way.last_mut() {
        let (of, within) = (top.of, top.within);
        let Some(&subtask) = schema(of).order.get(top.next) else {
            let end = top.ends.iter().fold(top.start, |end, &other| end.later(other));
            way.pop();
            if let Some(above) = way.last_mut() {
                above.ends[within as usize] = end;
            }
            continue;
        };
        top.next += 1;
        let before = schema(of).before[subtask as usize].iter();
        let start = before.fold(top.start, |start, &b| start.later(top.ends[b as usize]));
        let child = reading(of).children[subtask as usize];
        match references(plan, of)[child as usize].node {
            PlanNode::Step(step) => {
                if let Some(unplaced) = start.by.filter(|_| step.0 < start.slot) {
                    return Err(unplaced);
                }
                top.ends[subtask as usize] = start.later(Bound { slot: step.0 + 1, by: None });
            }
            PlanNode::Decomposition(task) => {
                visit(task, start.slot);
                let start = match &reading(Parent::Task(task)).holds {
                    None => start,
                    Some(holds) => match holds.get(holds.partition_point(|&slot| slot < start.slot)) {
                        None => return Err((task, start.slot)),
                        Some(&slot) if slot > start.slot => Bound { slot, by: Some((task, start.slot)) },
                        Some(_) => start,
                    },
                };
                way.push(frame(Parent::Task(task), start, subtask));
            }
        }
    }
    Ok(())
}
