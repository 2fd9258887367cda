//! The constants that a domain's conditions, effects and networks mention.

use pddl::model::{
    AssignedValue, Condition, ConditionKind, DerivedValue, Domain, Effect, EffectKind, Expression,
    ExpressionKind, ObjectId, Term, VariableId,
};

/// Visits each constant that a schema of the domain mentions.
pub(super) fn objects(domain: &Domain, visit: &mut impl FnMut(ObjectId)) {
    let mut terms = |terms: &[Term]| {
        for term in terms {
            if let Term::Object(id) = term {
                visit(*id);
            }
        }
    };
    for (_, action) in domain.actions.enumerate() {
        of_condition(&action.precondition, &mut terms);
        of_effect(&action.effect, &mut terms);
    }
    for (_, action) in domain.durative_actions.enumerate() {
        action.conditions.iter().for_each(|c| of_condition(&c.condition, &mut terms));
        action.effects.iter().for_each(|e| of_effect(&e.effect, &mut terms));
    }
    domain.axioms.iter().for_each(|axiom| of_condition(&axiom.body, &mut terms));
    for function in &domain.derived_functions {
        match &function.value {
            DerivedValue::Expression(value) => of_expression(value, &mut terms),
            DerivedValue::Count(_, condition) => of_condition(condition, &mut terms),
        }
    }
    for (_, method) in domain.methods.enumerate() {
        of_condition(&method.precondition, &mut terms);
        terms(&method.task_arguments);
        method.network.constraints.iter().for_each(|c| of_condition(c, &mut terms));
        method.network.subtasks.iter().for_each(|subtask| terms(&subtask.arguments));
    }
}

/// Visits the terms of a condition, a slice for each part of it.
pub(super) fn of_condition(condition: &Condition, terms: &mut impl FnMut(&[Term])) {
    condition.each(&mut |part| match &part.kind {
        ConditionKind::Atom(atom) => terms(&atom.arguments),
        ConditionKind::Same(left, right) => terms(&[*left, *right]),
        ConditionKind::HasType(term, _) => terms(&[*term]),
        ConditionKind::Compare(_, left, right) => {
            of_expression(left, terms);
            of_expression(right, terms);
        }
        ConditionKind::FluentIs(application, value) => {
            terms(&application.arguments);
            terms(&[*value]);
        }
        _ => {}
    });
}

fn of_expression(expression: &Expression, terms: &mut impl FnMut(&[Term])) {
    expression.each(&mut |part| {
        if let ExpressionKind::Fluent(application) = &part.kind {
            terms(&application.arguments);
        }
    });
}

fn of_effect(effect: &Effect, terms: &mut impl FnMut(&[Term])) {
    effect.each(&mut |part| match &part.kind {
        EffectKind::Add(atom) | EffectKind::Delete(atom) => terms(&atom.arguments),
        EffectKind::Assign(_, application, value) => {
            terms(&application.arguments);
            if let AssignedValue::Object(value) = value {
                terms(&[*value]);
            }
        }
        EffectKind::When(condition, _) => of_condition(condition, terms),
        EffectKind::And(_) | EffectKind::Forall(..) => {}
    });
}

/// The variables that a condition mentions, each once.
pub(in crate::check) fn variables_of(condition: &Condition, into: &mut Vec<VariableId>) {
    of_condition(condition, &mut |terms| {
        for term in terms {
            if let Term::Variable(variable) = term
                && !into.contains(variable)
            {
                into.push(*variable);
            }
        }
    });
}
