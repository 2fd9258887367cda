//! A repair in words.

use super::names::{show_application, show_atom, show_step, show_timed_step};
use crate::advice::Repair;
use crate::plan::{PlanRef, StepIndex};
use pddl::model::{Domain, Problem};
use pddl::{Plan, PlanStep};

/// The change in words: `inserting (unlock door) before step 3`.
pub fn show_repair(domain: &Domain, problem: &Problem, plan: &Plan, repair: &Repair) -> String {
    let show = |step: &PlanStep| format!("`{}`", show_step(domain, problem, step));
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
        Repair::Insert { before: index, steps } => {
            let steps: Vec<String> = steps.iter().map(show).collect();
            format!("inserting {} {}", steps.join(", "), before(*index))
        }
        Repair::InsertAt { step, delay } => {
            let mut text = format!("inserting `{}: {}", step.start, show_timed_step(domain, problem, step));
            if let Some(duration) = step.duration {
                text += &format!(" [{duration}]");
            }
            text += "`";
            if *delay != pddl::Decimal::ZERO {
                text += &format!(" and starting everything after it {delay} s later");
            }
            text
        }
        Repair::Move { step, before: index } => {
            format!("moving step {} {}", step.number(), before(*index))
        }
        Repair::Swap { first, second } => {
            format!("swapping steps {} and {}", first.number(), second.number())
        }
        Repair::Replace { step: index, arguments } => {
            let at = index.0 as usize;
            let text = match plan {
                Plan::Sequential(plan) => plan.steps.get(at).map(|old| {
                    show_step(domain, problem, &PlanStep { arguments: arguments.clone(), ..old.clone() })
                }),
                Plan::Temporal(plan) => plan.steps.get(at).map(|old| {
                    let step = pddl::TemporalStep { arguments: arguments.clone(), ..old.clone() };
                    show_timed_step(domain, problem, &step)
                }),
                Plan::Hierarchical(_) => None,
            };
            format!("making step {} `{}`", index.number(), text.unwrap_or_default())
        }
        Repair::Shift { step, start } => format!("starting step {} at {start}", step.number()),
        Repair::Delay { step, by } => {
            format!("starting step {}, and all that start with it or later, {by} s later", step.number())
        }
        Repair::Stretch { step, duration } => format!("letting step {} take {duration} s", step.number()),
        Repair::Decompose(_) => "another decomposition of the same steps".to_owned(),
        Repair::Initially(atom) => {
            format!("adding `{}` to the initial state", show_atom(domain, problem, atom))
        }
        Repair::NotInitially(atom) => {
            format!("taking `{}` out of the initial state", show_atom(domain, problem, atom))
        }
        Repair::Value { fluent, value } => {
            format!("letting `{}` be {value} in the initial state", show_application(domain, problem, fluent))
        }
        Repair::Without { .. } => "taking a part of the condition away".to_owned(),
    }
}
