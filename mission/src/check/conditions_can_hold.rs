//! C0402: a condition on a token that never holds.
//!
//! **What** Each token in a condition of a rule, a method, an intention, perception or an invariant may hold for some binding: it holds
//! initially, or something that may happen writes it.
//! **Why** Such a condition is always false, or always true under a `not`. Its author meant another token.
//! **Example** `(not (is speaker paused))`: only a test is ever paused.

use std::collections::BTreeSet;

use pddl::Span;
use pddl::model::{Condition, ConditionKind, Constraint, ConstraintKind, DerivedValue, Domain, Variables};

use super::context::Context;
use super::nearest::one_line;
use diagnostics::{Finding, Place, SourceId};

pub(super) fn check(context: &Context<'_>, findings: &mut Vec<Finding>) {
    let layers = &context.mission.layers;
    for agent in &layers.agents {
        for (_, rule) in agent.model.durative_actions.enumerate() {
            for timed in &rule.conditions {
                one(context, agent.source, &agent.model, &rule.variables, &timed.condition, findings);
            }
        }
    }
    let methods = &layers.methods;
    for (_, intention) in methods.model.durative_actions.enumerate() {
        for timed in &intention.conditions {
            one(context, methods.source, &methods.model, &intention.variables, &timed.condition, findings);
        }
    }
    for (_, method) in methods.model.methods.enumerate() {
        one(context, methods.source, &methods.model, &method.variables, &method.precondition, findings);
    }
    let perception = &layers.perception;
    for axiom in &perception.model.axioms {
        one(context, perception.source, &perception.model, &axiom.variables, &axiom.body, findings);
    }
    for function in &perception.model.derived_functions {
        if let DerivedValue::Count(_, condition) = &function.value {
            one(context, perception.source, &perception.model, &function.variables, condition, findings);
        }
    }
    for layer in &layers.safety {
        for invariant in &layer.model.invariants {
            of_constraint(&invariant.constraint, &mut |condition| {
                one(context, layer.source, &layer.model, &invariant.variables, condition, findings);
            });
        }
    }
}

/// Visits the conditions of a constraint.
fn of_constraint(constraint: &Constraint, visit: &mut impl FnMut(&Condition)) {
    match &constraint.kind {
        ConstraintKind::Holds(condition) => visit(condition),
        ConstraintKind::And(parts) | ConstraintKind::Or(parts) => {
            parts.iter().for_each(|part| of_constraint(part, visit));
        }
        ConstraintKind::Not(part)
        | ConstraintKind::Exists(_, part)
        | ConstraintKind::Forall(_, part)
        | ConstraintKind::AtEnd(part)
        | ConstraintKind::Always(part)
        | ConstraintKind::Sometime(part)
        | ConstraintKind::Within(_, part)
        | ConstraintKind::AtMostOnce(part)
        | ConstraintKind::HoldDuring(_, _, part)
        | ConstraintKind::HoldAfter(_, part) => of_constraint(part, visit),
        ConstraintKind::Imply(first, second)
        | ConstraintKind::SometimeAfter(first, second)
        | ConstraintKind::SometimeBefore(first, second)
        | ConstraintKind::AlwaysWithin(_, first, second) => {
            of_constraint(first, visit);
            of_constraint(second, visit);
        }
    }
}

fn one(
    context: &Context<'_>,
    source: SourceId,
    domain: &Domain,
    variables: &Variables,
    condition: &Condition,
    findings: &mut Vec<Finding>,
) {
    let grounding = context.grounding;
    // An unused token is a finding of C0401 or C0303 already.
    let reported: BTreeSet<Span> =
        findings.iter().filter(|f| f.place.source == source).map(|f| f.place.span).collect();
    condition.each(&mut |part| {
        if !matches!(part.kind, ConditionKind::Atom(_) | ConditionKind::FluentIs(..)) {
            return;
        }
        let mut slots = Vec::new();
        super::grounding::variables_of(part, &mut slots);
        let mut scope = grounding.scope(domain, variables);
        let mut holds = false;
        grounding.visit(&mut scope, &slots, &[part], &mut |_| holds = true);
        if !holds && !reported.contains(&part.span) {
            let text = one_line(context.mission.sources[source].slice(part.span));
            let place = Place { source, span: part.span };
            findings.push(Finding::warning("C0402", place, format!("`{text}` never holds")));
        }
    });
}
