//! The budget of a search for changes, and the validation of changed plans.

use crate::plan::PlanRef;
use crate::validator::Validator;
use crate::verdict::Verdict;

/// The cost of a step with times, in steps without times. It has a start, an end, and invariants in between.
const TIMED: usize = 8;

/// The budget of a search for changes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct AdviceLimits {
    /// The most changes to try.
    pub plans: usize,
    /// The most steps to execute for that.
    pub steps: usize,
    /// The most repairs of the plan, and of the task, to return.
    pub offers: usize,
}

impl Default for AdviceLimits {
    /// Well under a second for ordinary plans.
    fn default() -> Self {
        Self { plans: 6_000, steps: 400_000, offers: 3 }
    }
}

/// Judges changed plans while the budget lasts.
pub(super) struct Trials<'v, 'a> {
    pub(super) validator: &'v Validator<'a>,
    pub(super) budget: AdviceLimits,
}

impl Trials<'_, '_> {
    /// Whether the plan is valid; false if the budget is exhausted.
    pub(super) fn passes(&mut self, plan: PlanRef<'_>) -> bool {
        self.pays_for(plan) && self.validator.validate(plan).is_valid()
    }

    /// The same under a changed task.
    pub(super) fn passes_under(
        &mut self,
        validator: Result<Validator<'_>, Box<Verdict>>,
        plan: PlanRef<'_>,
    ) -> bool {
        self.pays_for(plan)
            && validator.is_ok_and(|v| {
                let v = v
                    .with_precision(self.validator.prepared.precision)
                    .with_thoroughness(self.validator.prepared.thoroughness);
                v.validate(plan).is_valid()
            })
    }

    pub(super) fn is_spent(&self) -> bool {
        self.budget.plans == 0
    }

    fn pays_for(&mut self, plan: PlanRef<'_>) -> bool {
        let steps = match plan {
            PlanRef::Temporal(_) => TIMED * (plan.steps() + 1),
            _ => plan.steps() + 1,
        };
        if self.budget.plans == 0 || self.budget.steps < steps {
            self.budget.plans = 0;
            return false;
        }
        self.budget.plans -= 1;
        self.budget.steps -= steps;
        true
    }
}
