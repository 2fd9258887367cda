//! A smallest change that makes a plan valid.
//!
//! Problem: a diagnosis says what is missing, and its reader wants to know what to do. Idea: the unsatisfied parts of
//! a failure name atoms; which instances of actions add (or delete) them just before the failing step, which step is
//! in the way, and which fact or condition is at fault, gives few candidates, each with one change. Changes of the plan
//! come before changes of the task, dropping before adding, what is near to the failure before what is far.
//!
//! Invariant: what is offered was applied, and the whole plan then judged valid. Nothing is shared with a planner.
//!
//! Cost: at most [`Budget::plans`] plans are judged, and no more than [`Budget::steps`] steps in all.

mod sequential;
mod task;
mod timed;

use crate::run::{PlanRef, Validator};
use crate::state::GroundAtom;
use crate::verdict::{Failure, StepIndex, Unsatisfied, Verdict};
use crate::words::{show_atom, show_step};
use pddl::model::{ActionId, Domain, Problem};
use pddl::{Decimal, Plan, PlanStep, Span};

/// How hard to look.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Budget {
    /// How many changed plans are judged.
    pub plans: usize,
    /// How many steps they have together.
    pub steps: usize,
}

impl Default for Budget {
    /// Well under a second for ordinary plans.
    fn default() -> Self {
        Self { plans: 2_000, steps: 400_000 }
    }
}

/// One change after which the plan is valid.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Repair {
    /// Leave a step out.
    Drop(StepIndex),
    /// Put a step before the one that is at a position now; behind the last one if there is none.
    Insert {
        /// Where.
        before: StepIndex,
        /// What.
        action: ActionId,
        /// With which arguments.
        arguments: Vec<pddl::model::ObjectId>,
    },
    /// Take a step earlier or later.
    Move {
        /// Which one.
        step: StepIndex,
        /// Before which one; behind the last one if there is none.
        before: StepIndex,
    },
    /// Give a step another argument.
    Replace {
        /// Which one.
        step: StepIndex,
        /// All its arguments then.
        arguments: Vec<pddl::model::ObjectId>,
    },
    /// Start a step at another time.
    Shift {
        /// Which one.
        step: StepIndex,
        /// When, in seconds.
        start: Decimal,
    },
    /// Let a step take another time.
    Stretch {
        /// Which one.
        step: StepIndex,
        /// How long, in seconds.
        duration: Decimal,
    },
    /// Let a fact hold from the beginning.
    Initially(GroundAtom),
    /// Take a part of the failing action's condition away.
    Without {
        /// Where it stands, in the domain.
        span: Span,
    },
}

impl Validator<'_> {
    /// Looks for one change that makes the plan valid; `failure` is why it is not.
    pub fn advise(&self, plan: &Plan, failure: &Failure, budget: Budget) -> Option<Repair> {
        let mut trials = Trials { validator: self, budget };
        match plan {
            Plan::Sequential(plan) => sequential::repair(&mut trials, plan, failure),
            Plan::Temporal(plan) => timed::repair(&mut trials, plan, failure),
            Plan::Hierarchical(_) => None,
        }
        .or_else(|| task::repair(&mut trials, plan.into(), failure))
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
            && validator.is_ok_and(|v| v.with_precision(self.validator.precision).validate(plan).is_valid())
    }

    fn is_spent(&self) -> bool {
        self.budget.plans == 0
    }

    fn pays_for(&mut self, plan: PlanRef<'_>) -> bool {
        let steps = plan.steps() + 1;
        if self.budget.plans == 0 || self.budget.steps < steps {
            self.budget.plans = 0;
            return false;
        }
        self.budget.plans -= 1;
        self.budget.steps -= steps;
        true
    }
}

/// What a failure lacks, if it is about a condition.
fn parts(failure: &Failure) -> &[Unsatisfied] {
    match failure {
        Failure::Precondition { parts, .. } | Failure::Invariant { parts, .. } | Failure::Goal { parts } => {
            parts
        }
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

/// The change in words: `inserting (unlock door) before step 3`.
pub fn show_repair(domain: &Domain, problem: &Problem, plan: &Plan, repair: &Repair) -> String {
    let step = |action: ActionId, arguments: &[pddl::model::ObjectId]| {
        let step = PlanStep { action, arguments: arguments.to_vec(), span: Span::default() };
        format!("`{}`", show_step(domain, problem, &step))
    };
    let steps = PlanRef::from(plan).steps();
    let before = |index: StepIndex| {
        if (index.0 as usize) < steps {
            format!("before step {}", index.number())
        } else {
            "at the end".to_owned()
        }
    };
    match repair {
        Repair::Drop(index) => format!("leaving out step {}", index.number()),
        Repair::Insert { before: index, action, arguments } => {
            format!("inserting {} {}", step(*action, arguments), before(*index))
        }
        Repair::Move { step, before: index } => {
            format!("moving step {} {}", step.number(), before(*index))
        }
        Repair::Replace { step: index, arguments } => {
            let text = match plan {
                Plan::Sequential(plan) => {
                    plan.steps.get(index.0 as usize).map(|old| step(old.action, arguments))
                }
                Plan::Temporal(_) | Plan::Hierarchical(_) => None,
            };
            format!("making step {} {}", index.number(), text.unwrap_or_default())
        }
        Repair::Shift { step, start } => format!("starting step {} at {start}", step.number()),
        Repair::Stretch { step, duration } => format!("letting step {} take {duration} s", step.number()),
        Repair::Initially(atom) => {
            format!("adding `{}` to the initial state", show_atom(domain, problem, atom))
        }
        Repair::Without { .. } => "taking a part of the condition away".to_owned(),
    }
}
