//! An effect that adds and deletes the same atom.

use pddl::model::{Atom, EffectKind, IndexVec, PredicateId};

use super::changes::Changes;
use super::literals::{Fact, required};
use crate::finding::Findings;
use crate::lint::{Check, explanation};
use crate::view::DomainView;
use crate::{Level, Lint, place};

pub(crate) static LINT: Lint = Lint {
    name: "contradictory-effect",
    level: Level::Default,
    explanation: explanation!("W0804"),
    checks: &[Check::Domain(check)],
};

fn check(view: &DomainView<'_>, found: &mut Findings) {
    let locks = locks(view);
    for schema in view.schemas() {
        for effects in schema.effects() {
            for (added, deleted) in contradictions(&Changes::of(effects)) {
                if !locks[deleted.predicate] {
                    let name = &view.domain.predicates[deleted.predicate].name;
                    let message = format!("`{name}` is made true and false at once: adding wins");
                    let finding = LINT.finding(place::domain(deleted.span), message);
                    found.report(finding.label(place::domain(added.span), "made true here"));
                }
            }
        }
    }
}

/// Pairs of the same atom that happen together: added, deleted.
pub(super) fn contradictions<'a>(changes: &Changes<'a>) -> Vec<(&'a Atom, &'a Atom)> {
    let mut pairs = Vec::new();
    for deleting in &changes.changes {
        let EffectKind::Delete(deleted) = &deleting.effect.kind else { continue };
        let added = changes.changes.iter().find_map(|change| match &change.effect.kind {
            EffectKind::Add(added)
                if change.context == deleting.context && Fact::of(added) == Fact::of(deleted) =>
            {
                Some(added)
            }
            _ => None,
        });
        pairs.extend(added.map(|added| (added, deleted)));
    }
    pairs
}

/// Predicates that actions ask for, take and give back in one step, and that nothing else takes: a way to keep
/// others from using a thing at the same time.
pub(super) fn locks(view: &DomainView<'_>) -> IndexVec<PredicateId, bool> {
    let mut locks: IndexVec<PredicateId, bool> = vec![true; view.domain.predicates.len()].into();
    for schema in view.schemas() {
        let asked: Vec<_> = schema.conditions().into_iter().flat_map(required).collect();
        for effects in schema.effects() {
            let changes = Changes::of(effects);
            let pairs = contradictions(&changes);
            for change in &changes.changes {
                let EffectKind::Delete(atom) = &change.effect.kind else {
                    continue;
                };
                let fact = Fact::of(atom);
                let held = asked.iter().any(|literal| literal.positive && literal.fact == fact);
                if !held || pairs.iter().all(|(added, _)| Fact::of(added) != fact) {
                    locks[atom.predicate] = false;
                }
            }
        }
    }
    locks
}
