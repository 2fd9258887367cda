//! `when` whose condition nothing ever changes.

use pddl::model::{Condition, EffectKind, Idx, Term};

use super::changes::Changes;
use crate::finding::Findings;
use crate::lint::{Check, explanation};
use crate::view::DomainView;
use crate::{Level, Lint, place};
use analysis::walk::{self, Part, Polarity};

pub(crate) static LINT: Lint = Lint {
    name: "static-when",
    level: Level::Pedantic,
    explanation: explanation!("W0819"),
    checks: &[Check::Domain(check)],
};

fn check(view: &DomainView<'_>, found: &mut Findings) {
    if !view.is_complete() {
        return;
    }
    for schema in view.schemas() {
        for effects in schema.effects() {
            for when in &Changes::of(effects).whens {
                // Without effect it is another mistake.
                let empty = matches!(&when.effect.kind, EffectKind::And(parts) if parts.is_empty());
                if !empty && is_fixed(view, when.condition, schema.variables().parameters) {
                    let message = "nothing changes whether this holds";
                    found.report(LINT.finding(place::domain(when.condition.span), message));
                }
            }
        }
    }
}

/// Whether the condition asks for something, only of objects and parameters, and nothing changes it.
fn is_fixed(view: &DomainView<'_>, condition: &Condition, parameters: usize) -> bool {
    let usage = view.usage();
    let (mut fixed, mut asks) = (true, false);
    walk::condition(condition, Polarity::Positive, &mut |part| {
        match part {
            Part::Needs(atom, _) => {
                let used = usage.predicates[atom.predicate];
                asks = true;
                fixed &= !used.fluent() && !used.timed;
            }
            Part::Reads(application) => {
                let used = usage.functions[application.function];
                asks = true;
                fixed &= !used.written && !used.timed;
            }
            _ => {}
        }
        let own = |term: &Term| match term {
            Term::Object(_) => true,
            Term::Variable(variable) => variable.index() < parameters,
        };
        fixed &= part.terms().iter().all(own);
    });
    fixed && asks
}
