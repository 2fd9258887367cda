//! Bodies as text that is the same for bodies that say the same: without places and names of variables, and with
//! the parts of conjunctions and disjunctions in one order.
//!
//! Two schemas of one shape do the same, one by one in the order of their parameters; schemas that do the same may
//! still differ in shape.

use std::fmt::Write as _;

use pddl::model::{
    AssignedValue, Condition, ConditionKind, Effect, EffectKind, Expression, ExpressionKind, TaskNetwork,
    Term,
};

pub(crate) fn condition(of: &Condition) -> String {
    match &of.kind {
        ConditionKind::And(parts) if parts.len() == 1 => condition(&parts[0]),
        ConditionKind::And(parts) => sorted("and", parts.iter().map(condition)),
        ConditionKind::Or(parts) => sorted("or", parts.iter().map(condition)),
        ConditionKind::Not(inner) => format!("(not {})", condition(inner)),
        ConditionKind::Imply(left, right) => format!("(imply {} {})", condition(left), condition(right)),
        ConditionKind::Exists(bound, inner) => format!("(exists {bound:?} {})", condition(inner)),
        ConditionKind::Forall(bound, inner) => format!("(forall {bound:?} {})", condition(inner)),
        ConditionKind::Atom(atom) => format!("(p{}{})", atom.predicate.0, terms(&atom.arguments)),
        ConditionKind::HasType(of, types) => format!("({types:?} {})", term(*of)),
        ConditionKind::Same(left, right) => sorted("=", [term(*left), term(*right)].into_iter()),
        ConditionKind::Compare(how, left, right) => {
            format!("({how:?} {} {})", expression(left), expression(right))
        }
        ConditionKind::FluentIs(application, value) => {
            format!("(= (f{}{}) {})", application.function.0, terms(&application.arguments), term(*value))
        }
    }
}

pub(crate) fn effect(of: &Effect) -> String {
    match &of.kind {
        EffectKind::And(parts) if parts.len() == 1 => effect(&parts[0]),
        EffectKind::And(parts) => sorted("and", parts.iter().map(effect)),
        EffectKind::Add(atom) => format!("(p{}{})", atom.predicate.0, terms(&atom.arguments)),
        EffectKind::Delete(atom) => format!("(not (p{}{}))", atom.predicate.0, terms(&atom.arguments)),
        EffectKind::Assign(operator, application, value) => {
            let value = match value {
                AssignedValue::Number(value) => expression(value),
                AssignedValue::Object(value) => term(*value),
                AssignedValue::Undefined => "undefined".to_owned(),
            };
            format!("({operator:?} (f{}{}) {value})", application.function.0, terms(&application.arguments))
        }
        EffectKind::Forall(bound, inner) => format!("(forall {bound:?} {})", effect(inner)),
        EffectKind::When(when, inner) => format!("(when {} {})", condition(when), effect(inner)),
    }
}

pub(crate) fn expression(of: &Expression) -> String {
    match &of.kind {
        ExpressionKind::Number(number) => number.to_string(),
        ExpressionKind::Fluent(application) => {
            format!("(f{}{})", application.function.0, terms(&application.arguments))
        }
        ExpressionKind::Arithmetic(operator, operands) => {
            let operands: Vec<String> = operands.iter().map(expression).collect();
            format!("({operator:?} {})", operands.join(" "))
        }
        ExpressionKind::Duration => "?duration".to_owned(),
        ExpressionKind::TotalTime => "total-time".to_owned(),
        ExpressionKind::IsViolated(name) => format!("(is-violated {name})"),
    }
}

pub(crate) fn network(of: &TaskNetwork) -> String {
    let mut text = String::new();
    for subtask in &of.subtasks {
        let _ = write!(text, "({:?}{})", subtask.head, terms(&subtask.arguments));
    }
    text += &sorted("and", of.constraints.iter().map(condition));
    let mut orderings: Vec<(u32, u32)> = of.orderings.iter().map(|o| (o.before, o.after)).collect();
    orderings.sort_unstable();
    let _ = write!(text, "{orderings:?}");
    text
}

pub(crate) fn terms(of: &[Term]) -> String {
    of.iter().fold(String::new(), |text, &t| text + " " + &term(t))
}

fn term(of: Term) -> String {
    match of {
        Term::Variable(variable) => format!("?{}", variable.0),
        Term::Object(object) => format!("{}", object.0),
    }
}

fn sorted(head: &str, parts: impl Iterator<Item = String>) -> String {
    let mut parts: Vec<String> = parts.collect();
    parts.sort_unstable();
    format!("({head} {})", parts.join(" "))
}
