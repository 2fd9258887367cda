//! The kernels of a plan: one condition per suffix, kept satisfied-or-not per change.
//!
//! Invariant: `missing[i]` is the number of literals of kernel `i` that do not hold in the loaded
//! state. Cost: building is linear in the sum of the kernels; a change of one fact touches only the
//! kernels that mention it; the furthest kernel is found in one pass over the counters.
//!
//! Exact for operators without conditional or numeric effects and tasks without axioms; [`Monitor`](super::Monitor)
//! simulates the others.

use planner::{FactId, Goal, Kernel, OperatorId, State, Task};
use rustc_hash::FxHashMap;

/// A fact with its sign.
pub(super) type Literal = (FactId, bool);

/// The kernels of one plan over one changing state.
#[derive(Clone, Debug)]
pub(super) struct Kernels {
    conditions: Vec<Vec<Literal>>,
    missing: Vec<usize>,
    mentions: FxHashMap<FactId, Vec<(usize, bool)>>,
}

impl Kernels {
    /// Regresses `goal` through `plan`, and counts against `state`.
    pub(super) fn new(task: &Task, plan: &[OperatorId], goal: &Goal, state: &State) -> Self {
        let mut kernel = Kernel::new(task, &goal.literals);
        let mut conditions = vec![kernel.iter().collect::<Vec<_>>()];
        for &step in plan.iter().rev() {
            kernel.before(step);
            conditions.push(kernel.iter().collect());
        }
        conditions.reverse();
        let mut mentions: FxHashMap<FactId, Vec<(usize, bool)>> = FxHashMap::default();
        let mut missing = vec![0; conditions.len()];
        for (suffix, condition) in conditions.iter().enumerate() {
            for &(fact, positive) in condition {
                mentions.entry(fact).or_default().push((suffix, positive));
                missing[suffix] += usize::from(state.contains(fact) != positive);
            }
        }
        Self { conditions, missing, mentions }
    }

    /// A fact of the state became true or false (it was the opposite before).
    pub(super) fn change(&mut self, fact: FactId, now: bool) {
        for &(suffix, positive) in self.mentions.get(&fact).map_or(&[][..], Vec::as_slice) {
            if positive == now {
                self.missing[suffix] -= 1;
            } else {
                self.missing[suffix] += 1;
            }
        }
    }

    /// The last suffix that reaches the goal from here; the plan's length if the goal holds.
    pub(super) fn furthest(&self) -> Option<usize> {
        self.missing.iter().rposition(|&missing| missing == 0)
    }

    /// The literals of a suffix's kernel.
    pub(super) fn condition(&self, suffix: usize) -> &[Literal] {
        &self.conditions[suffix]
    }
}
