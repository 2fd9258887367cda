//! C0301, C0302: an intention that starts no rule, or whose end no rule can bring about.
//!
//! **What** For each binding that methods give to an intention: some rule that may start waits for each token that the
//! intention writes at its start (or a method or perception reads it), and if the intention waits for something, a rule
//! waits for one of them. Some rule that may start brings about each effect at its end.
//! **Why** The executive sends no commands: a token for which no rule waits has no effect. The executive then waits until
//! the deadline, and blames devices that work.
//! **Example** `(say ?t opening greeting)` where `greeting` is an `utterance`, and the rules say a `remark` or a `summons`.

use std::collections::BTreeSet;

use pddl::model::{DurativeAction, TimeSpecifier};

use super::context::Context;
use super::grounding::{ClassId, Fact, Grounding, list};
use super::nearest::{self, Role};
use super::tokens;
use diagnostics::{Finding, Place};

pub(super) fn check(context: &Context<'_>, findings: &mut Vec<Finding>) {
    let grounding = context.grounding;
    let methods = &context.mission.layers.methods;
    let (heard, read) = (grounding.waited_for(), tokens::read_by_pelea(context.mission));
    for (id, bindings) in grounding.intentions() {
        let intention = &methods.model.durative_actions[id];
        let place = Place { source: methods.source, span: intention.name_span };
        let mut reported = BTreeSet::new();
        for binding in bindings {
            for (code, role, fact) in missing(grounding, intention, binding, &heard, &read) {
                // One finding a token of the intention: a wrong type concerns many bindings.
                if !reported.insert((code, fact.symbol.clone())) {
                    continue;
                }
                let names: Vec<&str> = binding.iter().map(|&c| grounding.classes.name(c).as_str()).collect();
                let (call, text) = (list(&intention.name, &names), fact.text(&grounding.classes));
                let message = match role {
                    Role::Waits => format!("`{call}` writes `{text}`, for which no rule waits"),
                    Role::Makes => format!("`{call}` waits for `{text}`, which no rule brings about"),
                    Role::Ends => format!("`{call}` waits for the end of `{text}`, which no rule ends"),
                };
                let mut finding = Finding::error(code, place, message);
                if let Some(near) = nearest::find(context.mission, grounding, &fact, role) {
                    finding = finding.related(near.place, near.reason);
                }
                findings.push(finding);
            }
        }
    }
}

/// What no rule does that the intention needs under a binding.
fn missing(
    grounding: &Grounding<'_>,
    intention: &DurativeAction,
    binding: &[ClassId],
    heard: &BTreeSet<&Fact>,
    read: &BTreeSet<pddl::model::Name>,
) -> Vec<(&'static str, Role, Fact)> {
    let start = grounding.effects(intention, binding, |when| *when == TimeSpecifier::Start);
    let end = grounding.effects(intention, binding, |when| *when == TimeSpecifier::End);
    let waits = !end.true_.is_empty();
    let mut missing = Vec::new();
    let reacts = start.true_.iter().any(|fact| heard.contains(fact));
    for fact in &start.true_ {
        let only_read = read.contains(&fact.symbol) && (reacts || !waits);
        if !heard.contains(fact) && !only_read {
            missing.push(("C0301", Role::Waits, fact.clone()));
        }
    }
    let made = end.true_.iter().filter(|fact| !grounding.written.may_hold(fact));
    missing.extend(made.map(|fact| ("C0302", Role::Makes, fact.clone())));
    let ended = end.false_.iter().filter(|fact| !grounding.written.may_cease(fact));
    missing.extend(ended.map(|fact| ("C0302", Role::Ends, fact.clone())));
    missing
}
