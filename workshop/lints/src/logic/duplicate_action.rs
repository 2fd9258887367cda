//! Two actions that do the same.

use pddl::Span;
use pddl::model::{DurativeAction, Name};
use rustc_hash::FxHashMap;

use crate::finding::Findings;
use crate::lint::{Check, explanation};
use crate::shape::{self, Shape};
use crate::view::DomainView;
use crate::{Level, Lint, place};

pub(crate) static LINT: Lint = Lint {
    name: "duplicate-action",
    level: Level::Default,
    explanation: explanation!("W0809"),
    checks: &[Check::Domain(check)],
};

fn check(view: &DomainView<'_>, found: &mut Findings) {
    if !view.is_complete() {
        return;
    }
    let mut first: FxHashMap<String, (&Name, Span)> = FxHashMap::default();
    // What is soft or continuous has no shape.
    let plain = view.domain.actions.iter().filter(|action| action.preferences.is_empty());
    let actions = plain.map(|action| {
        let body = |shape: &Shape| {
            format!("{} {}", shape.condition(&action.precondition), shape.effect(&action.effect))
        };
        (shape::schema(&action.variables, body), &action.name, action.name_span)
    });
    // What a rule does also lies in its skill, which may well be the same for many.
    let plain = view.domain.durative_actions.iter().filter(|action| {
        let instant = action.continuous.is_empty() && action.effects.iter().all(|e| e.given.is_empty());
        action.rule.is_none() && instant && action.preferences.is_empty()
    });
    let durative = plain.map(|action| {
        let shape = shape::schema(&action.variables, |shape| durative(action, shape));
        (shape, &action.name, action.name_span)
    });
    for (shape, name, span) in actions.chain(durative) {
        if let Some((other, earlier)) = first.get(&shape) {
            let message = format!("action `{name}` does the same as `{other}`");
            let finding = LINT.finding(place::domain(span), message);
            found.report(finding.label(place::domain(*earlier), "the other one"));
        } else {
            first.insert(shape, (name, span));
        }
    }
}

fn durative(action: &DurativeAction, shape: &Shape) -> String {
    let mut parts: Vec<String> = Vec::new();
    parts
        .extend(action.duration.iter().map(|d| format!("{:?} {}", d.comparison, shape.expression(&d.bound))));
    parts.extend(action.conditions.iter().map(|c| format!("{:?} {}", c.when, shape.condition(&c.condition))));
    parts.extend(action.effects.iter().map(|e| format!("do {:?} {}", e.when, shape.effect(&e.effect))));
    parts.sort_unstable();
    parts.join(" ")
}
