//! C0201: an effect that perception cannot see.
//!
//! **What** `perception.pddl` derives every predicate that an action of the plan changes.
//! **Why** Effects are sensed, not asserted: without an axiom the executive waits for the effect until its
//! deadline, every time.
//! **Example** `:effect (greeted ?p)` with no `(:derived (greeted ?p - person) …)`.

use std::collections::BTreeSet;

use super::tokens::Tokens;
use crate::mission::Mission;
use diagnostics::{Finding, Place};

pub(super) fn check(mission: &Mission, findings: &mut Vec<Finding>) {
    let (domain, perception) = (&mission.layers.domain, &mission.layers.perception.model);
    let derived: BTreeSet<_> =
        perception.axioms.iter().map(|a| perception.predicates[a.predicate].name.clone()).collect();
    for (_, action) in domain.model.actions.enumerate() {
        let mut changed = Tokens::of(&domain.model);
        changed.effect(&action.effect);
        for name in changed.names.difference(&derived) {
            let place = Place { source: domain.source, span: action.effect.span };
            let message = format!("`{}` changes `{name}`, which perception does not derive", action.name);
            let help = format!("add (:derived ({name} …) …) to the perception");
            findings.push(Finding::error("C0201", place, message).help(help));
        }
    }
}
