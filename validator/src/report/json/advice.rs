//! Advice as JSON: a change that makes the plan valid, in words and as data.

use crate::advice::Repair;
use crate::plan::StepIndex;
use crate::report::finding::Place;
use crate::report::names::{show_application, show_atom};
use crate::report::repair::show_repair;
use crate::report::subject::Subject;
use crate::verdict::File;
use pddl::print_plan;
use serde::Serialize;
use std::collections::HashMap;

/// A change that makes the plan valid. Steps are counted from 1. Fields that a kind of change does
/// not need are omitted.
#[derive(Serialize)]
pub(super) struct AdviceRecord {
    change: &'static str,
    pub(super) text: String,
    /// The step, or the first of two.
    #[serde(skip_serializing_if = "Option::is_none")]
    step: Option<u64>,
    /// The other step of a swap.
    #[serde(skip_serializing_if = "Option::is_none")]
    with: Option<u64>,
    /// The step of the original plan before which to insert.
    #[serde(skip_serializing_if = "Option::is_none")]
    before: Option<u64>,
    /// The new lines of the plan.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    lines: Vec<String>,
    /// The fact or the value of the initial state, or the part of the condition.
    #[serde(skip_serializing_if = "Option::is_none")]
    pddl: Option<String>,
}

impl AdviceRecord {
    /// The record of a repair.
    pub(super) fn of(subject: &Subject<'_>, repair: &Repair) -> Self {
        let Subject { domain, problem, plan, .. } = *subject;
        let part = |span| subject.slice(Place { file: File::Domain, span }).to_owned();
        let text = match repair {
            Repair::Without { span } => format!("taking `{}` out of the condition", part(*span)),
            _ => show_repair(domain, problem, plan, repair),
        };
        let (step, with, before) = match repair {
            Repair::Drop(step)
            | Repair::Replace { step, .. }
            | Repair::Shift { step, .. }
            | Repair::Delay { step, .. }
            | Repair::Stretch { step, .. } => (Some(*step), None, None),
            Repair::Insert { before, .. } => (None, None, Some(*before)),
            Repair::Move { step, before } => (Some(*step), None, Some(*before)),
            Repair::Swap { first, second } => (Some(*first), Some(*second), None),
            _ => (None, None, None),
        };
        Self {
            change: change(repair),
            text: format!("{text} makes the plan valid"),
            step: step.map(StepIndex::number),
            with: with.map(StepIndex::number),
            before: before.map(StepIndex::number),
            lines: lines(subject, repair),
            pddl: match repair {
                Repair::Initially(atom) | Repair::NotInitially(atom) => {
                    Some(show_atom(domain, problem, atom))
                }
                Repair::Value { fluent, value } => {
                    Some(format!("(= {} {value})", show_application(domain, problem, fluent)))
                }
                Repair::Without { span } => Some(part(*span)),
                _ => None,
            },
        }
    }
}

/// The lines of the repaired plan that the original plan lacks.
fn lines(subject: &Subject<'_>, repair: &Repair) -> Vec<String> {
    let Subject { domain, problem, plan, .. } = *subject;
    if matches!(repair, Repair::Drop(_) | Repair::Move { .. }) {
        return Vec::new();
    }
    let Some(repaired) = repair.applied(plan) else { return Vec::new() };
    let old = print_plan(plan, domain, problem);
    let new = print_plan(&repaired, domain, problem);
    let mut left: HashMap<&str, usize> = HashMap::new();
    for line in old.lines() {
        *left.entry(line).or_default() += 1;
    }
    let mut lines = Vec::new();
    for line in new.lines() {
        match left.get_mut(line) {
            Some(count) if *count > 0 => *count -= 1,
            _ => lines.push(line.to_owned()),
        }
    }
    lines
}

/// The kind of change, in one word.
const fn change(repair: &Repair) -> &'static str {
    match repair {
        Repair::Drop(_) => "drop",
        Repair::Insert { .. } | Repair::InsertAt { .. } => "insert",
        Repair::Move { .. } => "move",
        Repair::Swap { .. } => "swap",
        Repair::Replace { .. } => "replace",
        Repair::Shift { .. } => "shift",
        Repair::Delay { .. } => "delay",
        Repair::Stretch { .. } => "stretch",
        Repair::Decompose(_) => "decompose",
        Repair::Initially(_) => "initially",
        Repair::NotInitially(_) => "not_initially",
        Repair::Value { .. } => "value",
        Repair::Without { .. } => "without",
    }
}
