//! The kernels of a plan: one condition per suffix, kept satisfied-or-not per change.
//!
//! Invariant: `missing[i]` is the number of literals of kernel `i` that do not hold in the loaded
//! state. Cost: building is linear in the sum of the kernels; a change of one fact touches only the
//! kernels that mention it; the furthest kernel is found in one pass over the counters.
//!
//! Exact for operators without conditional or numeric effects and tasks without axioms; [`Monitor`](super::Monitor)
//! simulates the others.

use planner::{FactId, Goal, OperatorId, State, Task};
use rustc_hash::FxHashMap;
use std::collections::BTreeMap;

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
    /// Whether regression is exact for this plan.
    pub(super) fn can_regress(task: &Task, plan: &[OperatorId]) -> bool {
        let regresses = |&o: &OperatorId| {
            let operator = task.operator(o);
            operator.conditional.is_empty() && !operator.changes_numbers()
        };
        task.axioms().is_empty() && plan.iter().all(regresses)
    }

    /// Regresses `goal` through `plan`, and counts against `state`.
    pub(super) fn new(task: &Task, plan: &[OperatorId], goal: &Goal, state: &State) -> Self {
        let mut kernel: BTreeMap<FactId, bool> = BTreeMap::new();
        require(&mut kernel, goal.literals.as_ref());
        let mut conditions = vec![kernel.iter().map(|(&f, &b)| (f, b)).collect::<Vec<_>>()];
        for &operator in plan.iter().rev() {
            let operator = task.operator(operator);
            for fact in operator.adds {
                if kernel.get(fact) == Some(&true) {
                    kernel.remove(fact);
                }
            }
            for fact in operator.deletes {
                if kernel.get(fact) == Some(&false) {
                    kernel.remove(fact);
                }
            }
            require(&mut kernel, operator.precondition);
            conditions.push(kernel.iter().map(|(&f, &b)| (f, b)).collect());
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

fn require(kernel: &mut BTreeMap<FactId, bool>, literals: planner::LiteralsRef<'_>) {
    kernel.extend(literals.positive.iter().map(|&f| (f, true)));
    kernel.extend(literals.negative.iter().map(|&f| (f, false)));
}
