//! C0201–C0203: an effect that perception cannot see.
//!
//! **What** `perception.pddl` derives every predicate that an action of the plan changes, and some run may bring about
//! each fact that the action adds. It derives every number that an action changes, unless the metric alone reads it.
//! **Why** Effects are sensed, not asserted: without an axiom the executive waits for the effect until its deadline, every
//! time. Only costs, which no condition reads, need no sensor.
//! **Example** `:effect (greeted ?p)` with no `(:derived (greeted ?p - person) …)`.

use std::collections::BTreeSet;

use pddl::model::{Action, EffectKind, Name};

use super::context::Context;
use super::grounding::Facts;
use super::tokens::Tokens;
use diagnostics::{Finding, Place};

pub(super) fn check(context: &Context<'_>, findings: &mut Vec<Finding>) {
    let layers = &context.mission.layers;
    let (domain, perception) = (&layers.domain, &layers.perception.model);
    let mut derived: BTreeSet<_> =
        perception.axioms.iter().map(|a| perception.predicates[a.predicate].name.clone()).collect();
    let numbers = perception.derived_functions.iter();
    derived.extend(numbers.map(|f| perception.functions[f.function].name.clone()));
    let costs = costs(context);
    for (_, action) in layers.steps.actions.enumerate() {
        let mut changed = Tokens::of(&domain.model);
        changed.effect(&action.effect);
        let place = Place { source: domain.source, span: action.effect.span };
        for name in changed.names.difference(&derived).filter(|name| !costs.contains(*name)) {
            if domain.model.function(name).is_some() {
                let message = format!("`{}` changes `{name}`, which perception does not derive", action.name);
                let help = format!(
                    "add (:derived ({name} …) …) to the perception: an attribute, or a count; only what the metric \
                     alone reads needs no sensor"
                );
                findings.push(Finding::error("C0202", place, message).help(help));
                continue;
            }
            let message = format!("`{}` changes `{name}`, which perception does not derive", action.name);
            let help = format!("add (:derived ({name} …) …) to the perception");
            findings.push(Finding::error("C0201", place, message).help(help));
        }
        never_seen(context, action, place, &derived, findings);
    }
}

/// The facts that the action adds and that perception never derives, one for each predicate.
fn never_seen(
    context: &Context<'_>,
    action: &Action,
    place: Place,
    derived: &BTreeSet<Name>,
    findings: &mut Vec<Finding>,
) {
    let (grounding, domain) = (context.grounding, &context.mission.layers.steps);
    let mut reported = BTreeSet::new();
    for (id, arguments) in &grounding.actions {
        if domain.actions[*id].name != action.name {
            continue;
        }
        let mut written = Facts::default();
        let mut scope = grounding.bound(domain, &action.variables, arguments);
        scope.write(&action.effect, &[], &grounding.known(), &mut written);
        for fact in written.true_.difference(&grounding.derived) {
            if derived.contains(&fact.symbol) && reported.insert(fact.symbol.clone()) {
                let text = fact.text(&grounding.classes);
                let message =
                    format!("`{}` is to bring about `{text}`, which is never perceived", action.name);
                let help = "no rule or intention of the mission writes what the perception derives it from";
                findings.push(Finding::error("C0203", place, message).help(help));
            }
        }
    }
}

/// The numbers that actions change and that no condition, value or goal reads.
fn costs(context: &Context<'_>) -> BTreeSet<Name> {
    let layers = &context.mission.layers;
    let domain = &layers.steps;
    let mut read = Tokens::of(domain);
    let mut changed = Tokens::of(domain);
    for (_, action) in domain.actions.enumerate() {
        read.condition(&action.precondition);
        action.effect.each(&mut |part| match &part.kind {
            EffectKind::When(condition, _) => read.condition(condition),
            EffectKind::Assign(_, application, value) => {
                changed.application(application);
                read.value(value);
            }
            _ => {}
        });
    }
    let durative = domain.durative_actions.iter().flat_map(|action| &action.conditions);
    durative.for_each(|timed| read.condition(&timed.condition));
    domain.axioms.iter().for_each(|axiom| read.condition(&axiom.body));
    read.condition(&layers.problem.model.goal);
    context.mission.goals.iter().for_each(|goal| read.condition(&goal.condition));
    let is_number = |name: &&Name| {
        let id = domain.function(name);
        id.is_some_and(|id| domain.functions[id].value == pddl::model::FunctionValue::Number)
    };
    changed.names.difference(&read.names).filter(is_number).cloned().collect()
}
