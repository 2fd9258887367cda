//! C0301, C0302: an intention to which no agent reacts, or whose end no rule can bring about.
//!
//! **What** Some rule of an agent (at its start or over all), a method or perception reads what an intention
//! writes at its start. Some rule writes what the intention waits for at its end.
//! **Why** The executive sends no commands: a token that no agent reads has no effect.
//! **Example** `(at start (assign (view ?t ?i) ?u))` when no rule mentions `view`.

use std::collections::BTreeSet;

use pddl::model::{Name, TimeSpecifier};

use super::tokens::{Tokens, written_by_rules};
use crate::mission::Mission;
use diagnostics::{Finding, Place};

pub(super) fn check(mission: &Mission, findings: &mut Vec<Finding>) {
    let methods = &mission.layers.methods;
    let heard = heard(mission);
    let written = written_by_rules(mission);
    for (_, intention) in methods.model.durative_actions.enumerate() {
        let place = Place { source: methods.source, span: intention.name_span };
        let starts = Tokens::of(&methods.model).effects(intention, |w| *w == TimeSpecifier::Start);
        let ends = Tokens::of(&methods.model).effects(intention, |w| *w == TimeSpecifier::End);
        if !starts.is_empty() && starts.is_disjoint(&heard) {
            let names: Vec<&str> = starts.iter().map(Name::as_str).collect();
            let message = format!("no agent reads what `{}` writes: {}", intention.name, names.join(", "));
            findings.push(Finding::error("C0301", place, message));
        }
        for name in ends.difference(&written) {
            let message = format!("`{}` waits for `{name}`, which no agent's rule writes", intention.name);
            findings.push(Finding::error("C0302", place, message));
        }
    }
}

/// The tokens that rules, methods and perception read.
fn heard(mission: &Mission) -> BTreeSet<Name> {
    let layers = &mission.layers;
    let mut heard = BTreeSet::new();
    for agent in &layers.agents {
        for (_, rule) in agent.model.durative_actions.enumerate() {
            heard.extend(Tokens::of(&agent.model).conditions(rule, |_| true));
        }
    }
    let mut methods = Tokens::of(&layers.methods.model);
    layers.methods.model.methods.enumerate().for_each(|(_, m)| methods.condition(&m.precondition));
    heard.append(&mut methods.names);
    let mut perception = Tokens::of(&layers.perception.model);
    layers.perception.model.axioms.iter().for_each(|a| perception.condition(&a.body));
    heard.append(&mut perception.names);
    heard
}
