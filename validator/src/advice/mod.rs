//! The smallest changes that make a plan valid.
//!
//! Problem: a diagnosis names what is missing, and its reader wants to know what to do. Idea: the unsatisfied parts
//! of a failure are the wants (`wants`). The instances of actions that achieve a want (`instances`), the step that
//! undid it last, and the fact or condition at fault give a few candidates with one change each. A changed plan
//! without times is executed only from the change on, in a state that moves back and forth (`track`); a changed plan
//! with times is executed as a whole. Changes of the plan come before changes of the task.
//!
//! Invariant: each repair was applied, and the whole changed plan is valid. No code is shared with a planner.
//!
//! Cost: at most [`AdviceLimits::plans`] changes are tried and [`AdviceLimits::steps`] steps executed; a step with
//! times counts as several.

mod apply;
mod bridge;
mod change;
mod edit;
mod instances;
mod sequential;
mod sequential_case;
mod task;
mod timed;
mod timed_case;
mod timed_insert;
mod track;
mod trials;
mod wants;

pub use change::Repair;
pub use trials::AdviceLimits;

use crate::validator::Validator;
use crate::verdict::{Failure, Verdict};
use crate::work::Thoroughness;
use pddl::model::Idx;
use pddl::{DecompositionId, HierarchicalPlan, Plan, PlanLabel, SequentialPlan};
use trials::Trials;

/// The most changed plans for which a decomposition is searched.
const SEARCHED_PLANS: usize = 400;

impl Validator<'_> {
    /// Searches for single changes that make the plan valid, the smallest and most likely first. `failure` is the
    /// reason why the plan is invalid.
    pub fn advise(&self, plan: &Plan, failure: &Failure, budget: AdviceLimits) -> Vec<Repair> {
        // With a task network, each changed plan needs a search for a decomposition.
        let (brief, budget) = match (plan, &self.prepared.problem.htn) {
            (Plan::Sequential(_), Some(_)) => {
                let plans = budget.plans.min(SEARCHED_PLANS);
                (Some(self.clone().with_thoroughness(Thoroughness::Brief)), AdviceLimits { plans, ..budget })
            }
            _ => (None, budget),
        };
        let mut trials = Trials { validator: brief.as_ref().unwrap_or(self), budget };
        if trials.is_spent() {
            return Vec::new();
        }
        let mut repairs = match plan {
            Plan::Sequential(plan) => sequential::repairs(&mut trials, plan, failure),
            Plan::Temporal(plan) => timed::repairs(&mut trials, plan, failure),
            Plan::Hierarchical(plan) => self.decomposed_otherwise(plan, failure).into_iter().collect(),
        };
        // Changes of the task have their own budget.
        trials.budget = budget;
        let weaker = repairs.is_empty();
        repairs.extend(task::repairs(&mut trials, plan.into(), failure));
        if weaker {
            repairs.extend(task::weaker(&mut trials, plan.into(), failure));
        }
        repairs
    }
}

impl Validator<'_> {
    /// The same steps with another decomposition, if only the decomposition is invalid.
    fn decomposed_otherwise(&self, plan: &HierarchicalPlan, failure: &Failure) -> Option<Repair> {
        if !matches!(failure, Failure::Network { .. }) {
            return None;
        }
        let steps = SequentialPlan::new(plan.steps.iter().map(|step| step.step.clone()).collect());
        let Verdict::Valid(valid) = self.validate(&steps) else { return None };
        let mut found = *valid.decomposition?;
        // The actions keep their numbers, and the tasks get new ones.
        let mut next = plan.steps.iter().map(|step| step.label.0).max().unwrap_or(0);
        found.steps.clone_from(&plan.steps);
        for task in 0..found.decompositions.len() {
            next = next.checked_add(1)?;
            found.decompositions[DecompositionId::from_index(task)].label = PlanLabel(next);
        }
        Some(Repair::Decompose(Box::new(found)))
    }
}
