//! Smallest changes that make a plan valid.
//!
//! Problem: a diagnosis says what is missing, and its reader wants to know what to do. Idea: the unsatisfied parts of
//! a failure are what is wanted (`wants`); which instances of actions bring that about (`instances`), which step took
//! it away last, and which fact or condition is at fault, gives few candidates, each with one change. Plans without
//! times are tried from the change on only, in a state that walks back and forth (`track`); plans with times as a
//! whole. Changes of the plan come before changes of the task.
//!
//! Invariant: what is offered was applied, and the whole plan then judged valid. Nothing is shared with a planner.
//!
//! Cost: at most [`Budget::plans`] changes are tried, and no more than [`Budget::steps`] steps taken, one with times
//! counting for [`TIMED`].

mod apply;
mod bridge;
mod edit;
mod instances;
mod sequential;
mod task;
mod timed;
mod timed_insert;
mod track;
mod wants;
mod words;

pub use words::show_repair;

use crate::htn::Patience;
use crate::number::Number;
use crate::run::{PlanRef, Validator};
use crate::state::GroundAtom;
use crate::verdict::{Failure, StepIndex, Unsatisfied, Verdict};
use pddl::model::{GroundApplication, Idx, ObjectId};
use pddl::{
    Decimal, DecompositionId, HierarchicalPlan, Plan, PlanLabel, PlanStep, SequentialPlan, Span, TemporalStep,
};

/// How many changed plans are searched for a decomposition.
const SEARCHED_PLANS: usize = 400;

/// What a step with times costs, in steps without: it starts and ends, and things must hold in between.
const TIMED: usize = 8;

/// How hard to look.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Budget {
    /// How many changes are tried.
    pub plans: usize,
    /// How many steps are taken for that.
    pub steps: usize,
    /// How many changes of the plan, and how many of the task, are enough.
    pub offers: usize,
}

impl Default for Budget {
    /// Well under a second for ordinary plans.
    fn default() -> Self {
        Self { plans: 6_000, steps: 400_000, offers: 3 }
    }
}

/// One change after which the plan is valid.
#[derive(Clone, Debug)]
pub enum Repair {
    /// Leave a step out.
    Drop(StepIndex),
    /// Put steps before the one that is at a position now; behind the last one if there is none.
    Insert {
        /// Where.
        before: StepIndex,
        /// What; at least one.
        steps: Vec<PlanStep>,
    },
    /// Put a step into a plan with times.
    InsertAt {
        /// The step with its times.
        step: TemporalStep,
        /// By how much everything else that starts then or later starts later, in seconds.
        delay: Decimal,
    },
    /// Take a step earlier or later.
    Move {
        /// Which one.
        step: StepIndex,
        /// Before which one; behind the last one if there is none.
        before: StepIndex,
    },
    /// Let two steps change places.
    Swap {
        /// The earlier one.
        first: StepIndex,
        /// The later one.
        second: StepIndex,
    },
    /// Give a step another argument.
    Replace {
        /// Which one.
        step: StepIndex,
        /// All its arguments then.
        arguments: Vec<ObjectId>,
    },
    /// Start a step at another time.
    Shift {
        /// Which one.
        step: StepIndex,
        /// When, in seconds.
        start: Decimal,
    },
    /// Start a step, and all that start with it or later, later.
    Delay {
        /// From which one on.
        step: StepIndex,
        /// By how much, in seconds.
        by: Decimal,
    },
    /// Let a step take another time.
    Stretch {
        /// Which one.
        step: StepIndex,
        /// How long, in seconds.
        duration: Decimal,
    },
    /// Let the same steps come out of the task network in another way.
    Decompose(Box<HierarchicalPlan>),
    /// Let a fact hold from the beginning.
    Initially(GroundAtom),
    /// Let a fact not hold in the beginning.
    NotInitially(GroundAtom),
    /// Let a fluent have another value in the beginning.
    Value {
        /// Which one.
        fluent: GroundApplication,
        /// Its value.
        value: Number,
    },
    /// Take a part of the failing action's condition away.
    Without {
        /// Where it stands, in the domain.
        span: Span,
    },
}

impl Repair {
    /// Whether the plan is changed; otherwise it is the domain or the problem.
    pub fn is_of_plan(&self) -> bool {
        !matches!(
            self,
            Self::Initially(_) | Self::NotInitially(_) | Self::Value { .. } | Self::Without { .. }
        )
    }
}

impl Validator<'_> {
    /// Looks for single changes that make the plan valid, the smallest and most likely first; `failure` is why it is
    /// not.
    pub fn advise(&self, plan: &Plan, failure: &Failure, budget: Budget) -> Vec<Repair> {
        // For a task network each plan that is tried is searched for a decomposition.
        let (brief, budget) = match (plan, &self.problem.htn) {
            (Plan::Sequential(_), Some(_)) => {
                let plans = budget.plans.min(SEARCHED_PLANS);
                (Some(self.clone().with_patience(Patience::Brief)), Budget { plans, ..budget })
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
        // What remains of the budget for the plan is not what the task may cost.
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
    /// The same steps with another decomposition, if it is the decomposition that is wrong.
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

/// Judges changed plans while the budget lasts.
struct Trials<'v, 'a> {
    validator: &'v Validator<'a>,
    budget: Budget,
}

impl Trials<'_, '_> {
    /// Whether the plan is valid; no, if the budget is spent.
    fn passes(&mut self, plan: PlanRef<'_>) -> bool {
        self.pays_for(plan) && self.validator.validate(plan).is_valid()
    }

    /// The same under a changed task.
    fn passes_under(&mut self, validator: Result<Validator<'_>, Box<Verdict>>, plan: PlanRef<'_>) -> bool {
        self.pays_for(plan)
            && validator.is_ok_and(|v| {
                let v = v.with_precision(self.validator.precision).with_patience(self.validator.patience);
                v.validate(plan).is_valid()
            })
    }

    fn is_spent(&self) -> bool {
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

fn step_index(index: usize) -> StepIndex {
    StepIndex(u32::try_from(index).unwrap_or(u32::MAX))
}

/// What a failure lacks, if it is about a condition.
fn parts(failure: &Failure) -> &[Unsatisfied] {
    match failure {
        Failure::Precondition { parts, .. }
        | Failure::Invariant { parts, .. }
        | Failure::Constraint { parts, .. }
        | Failure::Goal { parts } => parts,
        _ => &[],
    }
}

/// Visits parts, nested ones too.
fn each_part<'p>(parts: &'p [Unsatisfied], visit: &mut dyn FnMut(&'p Unsatisfied)) {
    for part in parts {
        visit(part);
        match part {
            Unsatisfied::Alternatives { branches, .. } => {
                branches.iter().for_each(|branch| each_part(branch, visit));
            }
            Unsatisfied::Counterexample { parts, .. } => each_part(parts, visit),
            Unsatisfied::NoWitness { closest: Some(near), .. } => each_part(&near.parts, visit),
            _ => {}
        }
    }
}

/// A number as files write it, if they can.
fn decimal(number: Number) -> Option<Decimal> {
    number.to_string().parse().ok()
}
