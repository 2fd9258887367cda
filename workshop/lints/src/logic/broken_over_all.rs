//! A durative action that breaks its own `over all`.

use pddl::model::{EffectKind, TimeSpecifier};

use super::changes::Changes;
use super::literals::{Fact, required};
use crate::finding::Findings;
use crate::lint::{Check, explanation};
use crate::view::DomainView;
use crate::{Level, Lint, place};

pub(crate) static LINT: Lint = Lint {
    name: "broken-over-all",
    level: Level::Default,
    explanation: explanation!("W0810"),
    checks: &[Check::Domain(check)],
};

fn check(view: &DomainView<'_>, found: &mut Findings) {
    for action in &view.domain.durative_actions {
        let throughout = action.conditions.iter().filter(|c| c.when == TimeSpecifier::OverAll);
        let asked = required(throughout.map(|c| &c.condition));
        let at_start = action.effects.iter().filter(|e| e.when == TimeSpecifier::Start && e.given.is_empty());
        let changes = Changes::of(at_start.map(|e| &e.effect));
        // Adding wins over deleting.
        let added: Vec<Fact> = changes
            .certain()
            .filter_map(|effect| match &effect.kind {
                EffectKind::Add(atom) => Some(Fact::of(atom)),
                _ => None,
            })
            .collect();
        for effect in changes.certain() {
            let (atom, becomes) = match &effect.kind {
                EffectKind::Add(atom) => (atom, true),
                EffectKind::Delete(atom) if !added.contains(&Fact::of(atom)) => (atom, false),
                _ => continue,
            };
            if let Some(literal) = asked.iter().find(|l| l.positive != becomes && l.fact == Fact::of(atom)) {
                let message = "this takes away what the action itself asks for over all of its duration";
                let finding = LINT.finding(place::domain(effect.span), message);
                found.report(finding.label(place::domain(literal.span), "asked for here"));
            }
        }
    }
}
