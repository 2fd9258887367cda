//! The predicates and functions that parts of the model read.

use pddl::model::{Condition, ConditionKind, Effect, EffectKind, ExpressionKind, FunctionId, PredicateId};

/// Visits the predicates of a condition, and whether each is read positively.
pub(crate) fn each_predicate(
    condition: &Condition,
    positive: bool,
    visit: &mut dyn FnMut(PredicateId, bool),
) {
    match &condition.kind {
        ConditionKind::And(parts) | ConditionKind::Or(parts) => {
            for part in parts {
                each_predicate(part, positive, visit);
            }
        }
        ConditionKind::Not(part) => each_predicate(part, !positive, visit),
        ConditionKind::Imply(if_, then) => {
            each_predicate(if_, !positive, visit);
            each_predicate(then, positive, visit);
        }
        ConditionKind::Exists(_, part) | ConditionKind::Forall(_, part) => {
            each_predicate(part, positive, visit);
        }
        ConditionKind::Atom(atom) => visit(atom.predicate, positive),
        ConditionKind::HasType(..)
        | ConditionKind::Same(..)
        | ConditionKind::Compare(..)
        | ConditionKind::FluentIs(..) => {}
    }
}

/// Visits every function that a condition reads.
pub(crate) fn each_function(condition: &Condition, visit: &mut impl FnMut(FunctionId)) {
    condition.each(&mut |part| match &part.kind {
        ConditionKind::Compare(_, left, right) => {
            for side in [left, right] {
                side.each(&mut |part| {
                    if let ExpressionKind::Fluent(application) = &part.kind {
                        visit(application.function);
                    }
                });
            }
        }
        ConditionKind::FluentIs(application, _) => visit(application.function),
        _ => {}
    });
}

/// Visits the conditions of conditional effects, and whether they are inside a universal effect.
pub(crate) fn each_guard<'e>(effect: &'e Effect, visit: &mut dyn FnMut(&'e Condition, bool)) {
    fn walk<'e>(effect: &'e Effect, universal: bool, visit: &mut dyn FnMut(&'e Condition, bool)) {
        match &effect.kind {
            EffectKind::And(parts) => {
                for part in parts {
                    walk(part, universal, visit);
                }
            }
            EffectKind::Forall(_, body) => walk(body, true, visit),
            EffectKind::When(guard, body) => {
                visit(guard, universal);
                walk(body, universal, visit);
            }
            EffectKind::Add(_) | EffectKind::Delete(_) | EffectKind::Assign(..) => {}
        }
    }
    walk(effect, false, visit);
}
