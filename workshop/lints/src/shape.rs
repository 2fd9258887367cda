//! Bodies as text that is the same for bodies that say the same: without places and names of variables, and with the
//! parts of conjunctions and disjunctions in one order.
//!
//! Problem: two schemas may do the same although their parameters stand in another order. Idea: a parameter is known
//! by its type and by what the body looks like from it; parameters that this cannot tell apart are tried in every
//! order, and the least text counts. Invariant: schemas of one shape do the same; schemas that do the same may still
//! differ in shape. Cost: a text for each parameter, and one for each of at most [`ORDERS`] orders.

use std::fmt::Write as _;

use pddl::model::{
    AssignedValue, Condition, ConditionKind, Effect, EffectKind, Expression, ExpressionKind, Idx,
    TaskNetwork, Term, VariableId, Variables,
};

/// The most orders of parameters that are tried; where there are more, only one is.
const ORDERS: usize = 120;

/// How variables are written.
pub(crate) struct Shape {
    /// By slot: its number; `None` if it is written like every other variable.
    numbers: Vec<Option<usize>>,
}

/// The text that `body` makes of a schema, the same for every order of its parameters.
pub(crate) fn schema(variables: &Variables, body: impl Fn(&Shape) -> String) -> String {
    let slots = variables.slots.len();
    let mut looks: Vec<(Vec<u32>, String, usize)> = (0..variables.parameters)
        .map(|own| {
            let seen = |slot| match slot == own {
                true => Some(0),
                false => (slot >= variables.parameters).then_some(slot),
            };
            (types(variables, own), body(&Shape { numbers: (0..slots).map(seen).collect() }), own)
        })
        .collect();
    looks.sort_unstable();
    let alike = |a: &(Vec<u32>, String, usize), b: &(Vec<u32>, String, usize)| (&a.0, &a.1) == (&b.0, &b.1);
    let mut orders: Vec<Vec<usize>> = vec![Vec::new()];
    for group in looks.chunk_by(alike) {
        let members: Vec<usize> = group.iter().map(|look| look.2).collect();
        let own = match (1..=members.len()).try_fold(orders.len(), |n, k| (n * k <= ORDERS).then_some(n * k))
        {
            Some(_) => permutations(&members),
            None => vec![members],
        };
        orders = orders.iter().flat_map(|o| own.iter().map(|p| [o.as_slice(), p].concat())).collect();
    }
    let text = orders.into_iter().map(|order| {
        let mut numbers: Vec<Option<usize>> = (0..slots).map(Some).collect();
        order.iter().enumerate().for_each(|(number, &slot)| numbers[slot] = Some(number));
        body(&Shape { numbers })
    });
    let kinds: Vec<_> = looks.iter().map(|look| &look.0).collect();
    let bound: Vec<_> = (variables.parameters..slots).map(|slot| types(variables, slot)).collect();
    format!("{kinds:?} {bound:?} {}", text.min().unwrap_or_default())
}

fn types(variables: &Variables, slot: usize) -> Vec<u32> {
    let mut types: Vec<u32> =
        variables.slots[VariableId::from_index(slot)].types.0.iter().map(|t| t.0).collect();
    types.sort_unstable();
    types
}

fn permutations(of: &[usize]) -> Vec<Vec<usize>> {
    let Some((&first, rest)) = of.split_first() else { return vec![Vec::new()] };
    let shorter = permutations(rest);
    let inserted = shorter
        .iter()
        .flat_map(|order| (0..=order.len()).map(move |at| [&order[..at], &[first], &order[at..]].concat()));
    inserted.collect()
}

impl Shape {
    /// Every variable by its own number.
    pub(crate) const PLAIN: Self = Self { numbers: Vec::new() };

    pub(crate) fn condition(&self, of: &Condition) -> String {
        match &of.kind {
            ConditionKind::And(parts) if parts.len() == 1 => self.condition(&parts[0]),
            ConditionKind::And(parts) => sorted("and", parts.iter().map(|part| self.condition(part))),
            ConditionKind::Or(parts) => sorted("or", parts.iter().map(|part| self.condition(part))),
            ConditionKind::Not(inner) => format!("(not {})", self.condition(inner)),
            ConditionKind::Imply(left, right) => {
                format!("(imply {} {})", self.condition(left), self.condition(right))
            }
            ConditionKind::Exists(bound, inner) => format!("(exists {bound:?} {})", self.condition(inner)),
            ConditionKind::Forall(bound, inner) => format!("(forall {bound:?} {})", self.condition(inner)),
            ConditionKind::Atom(atom) => format!("(p{}{})", atom.predicate.0, self.terms(&atom.arguments)),
            ConditionKind::HasType(of, types) => format!("({types:?} {})", self.term(*of)),
            ConditionKind::Same(left, right) => {
                sorted("=", [self.term(*left), self.term(*right)].into_iter())
            }
            ConditionKind::Compare(how, left, right) => {
                format!("({how:?} {} {})", self.expression(left), self.expression(right))
            }
            ConditionKind::FluentIs(application, value) => {
                format!(
                    "(= (f{}{}) {})",
                    application.function.0,
                    self.terms(&application.arguments),
                    self.term(*value)
                )
            }
        }
    }

    pub(crate) fn effect(&self, of: &Effect) -> String {
        match &of.kind {
            EffectKind::And(parts) if parts.len() == 1 => self.effect(&parts[0]),
            EffectKind::And(parts) => sorted("and", parts.iter().map(|part| self.effect(part))),
            EffectKind::Add(atom) => format!("(p{}{})", atom.predicate.0, self.terms(&atom.arguments)),
            EffectKind::Delete(atom) => {
                format!("(not (p{}{}))", atom.predicate.0, self.terms(&atom.arguments))
            }
            EffectKind::Assign(operator, application, value) => {
                let value = match value {
                    AssignedValue::Number(value) => self.expression(value),
                    AssignedValue::Object(value) => self.term(*value),
                    AssignedValue::Undefined => "undefined".to_owned(),
                };
                format!(
                    "({operator:?} (f{}{}) {value})",
                    application.function.0,
                    self.terms(&application.arguments)
                )
            }
            EffectKind::Forall(bound, inner) => format!("(forall {bound:?} {})", self.effect(inner)),
            EffectKind::When(when, inner) => {
                format!("(when {} {})", self.condition(when), self.effect(inner))
            }
        }
    }

    pub(crate) fn expression(&self, of: &Expression) -> String {
        match &of.kind {
            ExpressionKind::Number(number) => number.to_string(),
            ExpressionKind::Fluent(application) => {
                format!("(f{}{})", application.function.0, self.terms(&application.arguments))
            }
            ExpressionKind::Arithmetic(operator, operands) => {
                let operands: Vec<String> = operands.iter().map(|part| self.expression(part)).collect();
                format!("({operator:?} {})", operands.join(" "))
            }
            ExpressionKind::Duration => "?duration".to_owned(),
            ExpressionKind::TotalTime => "total-time".to_owned(),
            ExpressionKind::IsViolated(name) => format!("(is-violated {name})"),
        }
    }

    pub(crate) fn network(&self, of: &TaskNetwork) -> String {
        let mut text = String::new();
        for subtask in &of.subtasks {
            let _ = write!(text, "({:?}{})", subtask.head, self.terms(&subtask.arguments));
        }
        text += &sorted("and", of.constraints.iter().map(|part| self.condition(part)));
        let mut orderings: Vec<(u32, u32)> = of.orderings.iter().map(|o| (o.before, o.after)).collect();
        orderings.sort_unstable();
        let _ = write!(text, "{orderings:?}");
        text
    }

    pub(crate) fn terms(&self, of: &[Term]) -> String {
        of.iter().fold(String::new(), |text, &t| text + " " + &self.term(t))
    }

    fn term(&self, of: Term) -> String {
        match of {
            Term::Variable(variable) => match self.numbers.get(variable.index()).copied() {
                Some(None) => "?".to_owned(),
                Some(Some(number)) => format!("?{number}"),
                None => format!("?{}", variable.0),
            },
            Term::Object(object) => format!("{}", object.0),
        }
    }
}

fn sorted(head: &str, parts: impl Iterator<Item = String>) -> String {
    let mut parts: Vec<String> = parts.collect();
    parts.sort_unstable();
    format!("({head} {})", parts.join(" "))
}
