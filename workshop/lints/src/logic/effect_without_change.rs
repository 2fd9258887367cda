//! An effect that makes true what is true.

use pddl::model::{AssignOperator, AssignedValue, Domain, Effect, EffectKind, ExpressionKind};

use super::changes::Changes;
use super::contradictory_effect::contradictions;
use super::literals::{Fact, Literal, required};
use crate::finding::Findings;
use crate::lint::{Check, explanation};
use crate::view::DomainView;
use crate::{Level, Lint, place};

pub(crate) static LINT: Lint = Lint {
    name: "effect-without-change",
    level: Level::Default,
    explanation: explanation!("W0806"),
    checks: &[Check::Domain(check)],
};

fn check(view: &DomainView<'_>, found: &mut Findings) {
    for schema in view.schemas() {
        for effects in schema.effects() {
            let changes = Changes::of(effects);
            for when in &changes.whens {
                compare(&required([when.condition]), when.effect, found);
            }
            for effect in changes.changes.iter().map(|change| change.effect) {
                if is_neutral(view.domain, effect) {
                    let message = "this leaves the number as it is";
                    found.report(LINT.finding(place::domain(effect.span), message));
                }
            }
        }
    }
    for action in &view.domain.actions {
        compare(&required([&action.precondition]), &action.effect, found);
    }
}

fn compare(asked: &[Literal], effect: &Effect, found: &mut Findings) {
    let changes = Changes::of([effect]);
    // What is both added and deleted is another mistake.
    let contradictions = contradictions(&changes);
    for effect in changes.certain() {
        let (atom, positive) = match &effect.kind {
            EffectKind::Add(atom) => (atom, true),
            EffectKind::Delete(atom) => (atom, false),
            _ => continue,
        };
        let fact = Fact::of(atom);
        if contradictions.iter().any(|(added, _)| Fact::of(added) == fact) {
            continue;
        }
        if let Some(literal) = asked.iter().find(|l| l.positive == positive && l.fact == fact) {
            let message = "this changes nothing, since the condition asks for it already";
            let finding = LINT.finding(place::domain(effect.span), message);
            found.report(finding.label(place::domain(literal.span), "asked for here"));
        }
    }
}

/// `(increase (f) 0)`, `(scale-up (f) 1)`; but that an action costs nothing may well be said.
fn is_neutral(domain: &Domain, effect: &Effect) -> bool {
    let EffectKind::Assign(operator, application, AssignedValue::Number(value)) = &effect.kind else {
        return false;
    };
    let ExpressionKind::Number(number) = value.kind else { return false };
    match operator {
        AssignOperator::Increase | AssignOperator::Decrease => {
            number == 0.0 && &*domain.functions[application.function].name != "total-cost"
        }
        AssignOperator::ScaleUp | AssignOperator::ScaleDown => number == 1.0,
        AssignOperator::Assign => false,
    }
}
