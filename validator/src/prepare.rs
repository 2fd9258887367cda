//! The initial state of a task, the relations to index, and the check that effects leave derived predicates alone.

use crate::axiom::Strata;
use crate::number::Number;
use crate::reads::{each_guard, each_predicate};
use crate::state::State;
use crate::value::Value;
use crate::verdict::IllFormed;
use pddl::model::{
    Condition, ConditionKind, Constraint, ConstraintKind, Domain, Effect, EffectKind, GroundApplication, Idx,
    Problem,
};

pub(crate) fn initial_state(domain: &Domain, problem: &Problem) -> State {
    let mut state = State::empty(domain, &joined(domain, problem));
    for fact in &problem.init {
        state.facts[fact.predicate].add(&fact.arguments, 0);
    }
    // Action costs start at 0 even if `:init` does not define them.
    if let Some(function) = domain.function("total-cost")
        && domain.functions[function].variables.parameters == 0
    {
        let total_cost = GroundApplication { function, arguments: Vec::new() };
        state.set_fluent(total_cost, Some(Value::Number(Number::ZERO)));
    }
    for fact in &problem.fluents {
        state.set_fluent(fact.application.clone(), Value::of(fact.value));
    }
    state
}

/// The predicates that are looked up by pattern: those inside quantifiers, axioms and universal
/// effects.
fn joined(domain: &Domain, problem: &Problem) -> Vec<bool> {
    let mut joined = vec![false; domain.predicates.len()];
    let mut derived = Vec::new();
    let mut mark = |condition: &Condition| {
        each_predicate(condition, true, &mut |predicate, _| joined[predicate.index()] = true);
    };
    for action in &domain.actions {
        each_quantified(&action.precondition, &mut mark);
        action.preferences.iter().for_each(|p| each_quantified(&p.body, &mut mark));
        quantified_guards(&action.effect, &mut mark);
    }
    for action in &domain.durative_actions {
        action.conditions.iter().for_each(|timed| each_quantified(&timed.condition, &mut mark));
        action.preferences.iter().for_each(|p| each_quantified(&p.body.condition, &mut mark));
        action.effects.iter().for_each(|timed| quantified_guards(&timed.effect, &mut mark));
    }
    for axiom in &domain.axioms {
        mark(&axiom.body);
        derived.push(axiom.predicate);
    }
    for process in &domain.processes {
        mark(&process.precondition);
    }
    for event in &domain.events {
        mark(&event.precondition);
        quantified_guards(&event.effect, &mut mark);
    }
    for method in &domain.methods {
        mark(&method.precondition);
    }
    for constraints in [&domain.constraints, &problem.constraints] {
        let soft = constraints.preferences.iter().map(|preference| &preference.body);
        constraints
            .hard
            .iter()
            .chain(soft)
            .for_each(|c| each_condition(c, &mut |c| each_quantified(c, &mut mark)));
    }
    each_quantified(&problem.goal, &mut mark);
    problem.preferences.iter().for_each(|preference| each_quantified(&preference.body, &mut mark));
    for predicate in derived {
        joined[predicate.index()] = true;
    }
    joined
}

fn quantified_guards(effect: &Effect, mark: &mut dyn FnMut(&Condition)) {
    each_guard(effect, &mut |guard, universal| {
        if universal {
            mark(guard);
        } else {
            each_quantified(guard, mark);
        }
    });
}

/// The conditions of a constraint.
fn each_condition(constraint: &Constraint, visit: &mut dyn FnMut(&Condition)) {
    match &constraint.kind {
        ConstraintKind::Holds(condition) => visit(condition),
        ConstraintKind::And(parts) | ConstraintKind::Or(parts) => {
            parts.iter().for_each(|part| each_condition(part, visit));
        }
        ConstraintKind::Imply(a, b)
        | ConstraintKind::SometimeAfter(a, b)
        | ConstraintKind::SometimeBefore(a, b)
        | ConstraintKind::AlwaysWithin(_, a, b) => {
            each_condition(a, visit);
            each_condition(b, visit);
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
        | ConstraintKind::HoldAfter(_, part) => each_condition(part, visit),
    }
}

/// The outermost quantified conditions.
fn each_quantified(condition: &Condition, visit: &mut dyn FnMut(&Condition)) {
    match &condition.kind {
        ConditionKind::Exists(_, body) | ConditionKind::Forall(_, body) => visit(body),
        _ => condition.parts().for_each(|part| each_quantified(part, visit)),
    }
}

pub(crate) fn derived_in_effect(effect: &Effect, strata: &Strata) -> Result<(), IllFormed> {
    match &effect.kind {
        EffectKind::Add(atom) | EffectKind::Delete(atom) if strata.derives(atom.predicate) => {
            Err(IllFormed::DerivedInEffect { predicate: atom.predicate, span: atom.span })
        }
        _ => effect.parts().iter().try_for_each(|part| derived_in_effect(part, strata)),
    }
}
