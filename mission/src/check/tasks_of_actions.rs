//! C0101, C0102: an action of the plan without a task or a method.
//!
//! **What** Every action of `domain.pddl` has a task of its name in `methods.hddl`, with parameters of the
//! same types, and the task has at least one method.
//! **Why** The planner puts the action into a plan, and the executive cannot execute it in front of the
//! patient.
//! **Example** `(:action greet :parameters (?p - person) …)` with no `(:task greet …)`.

use pddl::model::{TypeSet, TypeTable};

use super::context::Context;
use diagnostics::{Finding, Place};

pub(super) fn check(context: &Context<'_>, findings: &mut Vec<Finding>) {
    let mission = context.mission;
    let (domain, methods) = (&mission.layers.domain, &mission.layers.methods);
    for (_, action) in mission.layers.steps.actions.enumerate() {
        let place = Place { source: domain.source, span: action.name_span };
        let Some(task) = methods.model.task(&action.name) else {
            let message = format!("no task carries out the action `{}`", action.name);
            let help = format!("add (:task {} …) and a method for it to the methods", action.name);
            findings.push(Finding::error("C0101", place, message).help(help));
            continue;
        };
        let declared = &methods.model.tasks[task];
        let task_place = Place { source: methods.source, span: declared.span };
        let types = |table: &TypeTable, of: &TypeSet| -> Vec<String> {
            let mut names: Vec<String> = of.0.iter().map(|&t| table[t].name.to_string()).collect();
            names.sort_unstable();
            names
        };
        let of_action = action.variables.parameters().iter().map(|v| types(&domain.model.types, &v.types));
        let of_task = declared.variables.parameters().iter().map(|v| types(&methods.model.types, &v.types));
        if !of_action.eq(of_task) {
            let message = format!("the action `{}` and its task have different parameters", action.name);
            findings.push(Finding::error("C0102", place, message).related(task_place, "the task"));
        }
        if !methods.model.methods.enumerate().any(|(_, m)| m.task == task) {
            let message = format!("no method carries out the task `{}`", action.name);
            findings.push(Finding::error("C0101", task_place, message).related(place, "a plan may need it"));
        }
    }
}
