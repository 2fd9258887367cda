//! Comparisons of numbers, regressed through a step: its changes are substituted for the fluents.
//!
//! A change under a condition makes a case for each truth value of the condition. Too many cases,
//! too large an expression and coefficients that do not fit are refused; the suffix is then
//! simulated.

use super::super::{LiteralsRef, NumericEffects, Update};
use super::circuit::{ALWAYS, Circuit, Gate, NEVER, Node};
use crate::ids::FluentId;
use crate::number::{Change, Expression, NoValue, Operator, Relation};

/// The most conditions of changes that one comparison may depend on.
const CONDITIONS: usize = 4;
/// The most parts of an expression.
const PARTS: usize = 64;

/// Whether a step changes a number that the expression reads.
pub(super) fn changes(effects: &NumericEffects, expression: &Expression<FluentId>) -> bool {
    let mut changes = false;
    expression.each_fluent(&mut |f| changes |= effects.updates.iter().any(|update| update.fluent == *f));
    changes
}

/// The condition before the step under which the comparison has the wanted truth value after it;
/// `None` if we do not regress it.
pub(super) fn before(
    circuit: &mut Circuit,
    effects: &NumericEffects,
    (relation, expression): (Relation, &Expression<FluentId>),
    wanted: bool,
) -> Option<Node> {
    let mut read = Vec::new();
    expression.each_fluent(&mut |f| read.push(*f));
    let updates: Vec<&Update> = effects.updates.iter().filter(|u| read.contains(&u.fluent)).collect();
    let mut conditions: Vec<LiteralsRef<'_>> = Vec::new();
    for condition in updates.iter().map(|u| u.condition.as_ref()).filter(|c| !c.is_empty()) {
        if !conditions.contains(&condition) {
            conditions.push(condition);
        }
    }
    if conditions.len() > CONDITIONS {
        return None;
    }
    let mut cases = Vec::new();
    for case in 0..1_usize << conditions.len() {
        let holds = |i: usize| case >> i & 1 == 1;
        let fires = |update: &Update| {
            let own = update.condition.as_ref();
            conditions.iter().position(|&c| c == own).is_none_or(holds)
        };
        let value = |fluent: FluentId| value(fluent, updates.iter().copied().filter(|u| fires(u)));
        let compared = match substituted(expression, &value) {
            Ok(expression) => comparison(circuit, relation, expression, wanted)?,
            Err(NoValue::Undefined) => constant(!wanted),
            Err(NoValue::Overflow) => return None,
        };
        let mut all: Vec<Node> =
            conditions.iter().enumerate().map(|(i, &c)| circuit.literals(c, holds(i))).collect();
        all.push(compared);
        cases.push(circuit.all(all));
    }
    Some(circuit.any(cases))
}

fn constant(holds: bool) -> Node {
    if holds { ALWAYS } else { NEVER }
}

fn comparison(
    circuit: &mut Circuit,
    relation: Relation,
    expression: Expression<FluentId>,
    wanted: bool,
) -> Option<Node> {
    if let Some(value) = expression.as_constant() {
        return Some(constant(relation.holds(value.sign()) == wanted));
    }
    (parts(&expression) <= PARTS)
        .then(|| circuit.gate(Gate::Comparison(relation, Box::new(expression), wanted)))
}

/// The fluent's value after the updates, over the values before.
fn value<'u>(
    fluent: FluentId,
    updates: impl Iterator<Item = &'u Update>,
) -> Result<Expression<FluentId>, NoValue> {
    let mut own = Ok(Expression::fluent(fluent));
    for update in updates.filter(|u| u.fluent == fluent) {
        let by = update.value.clone().ok_or(NoValue::Undefined);
        own = match update.change {
            Change::Assign => by,
            Change::Shift => own?.plus(by?),
            Change::Scale => own?.times(by?),
        };
    }
    own
}

fn substituted(
    expression: &Expression<FluentId>,
    value: &impl Fn(FluentId) -> Result<Expression<FluentId>, NoValue>,
) -> Result<Expression<FluentId>, NoValue> {
    match expression {
        Expression::Linear(linear) => linear
            .terms
            .iter()
            .try_fold(Expression::constant(linear.constant), |sum, (fluent, coefficient)| {
                sum.plus(value(*fluent)?.times(Expression::constant(*coefficient))?)
            }),
        Expression::Tree(operator, parts) => {
            let mut parts = parts.iter().map(|part| substituted(part, value));
            let first = parts.next().unwrap_or(Ok(Expression::constant(crate::Number::ZERO)))?;
            parts.try_fold(first, |all, part| match operator {
                Operator::Add => all.plus(part?),
                Operator::Multiply => all.times(part?),
                Operator::Divide => all.over(part?),
            })
        }
    }
}

fn parts(expression: &Expression<FluentId>) -> usize {
    match expression {
        Expression::Linear(linear) => 1 + linear.terms.len(),
        Expression::Tree(_, inner) => 1 + inner.iter().map(parts).sum::<usize>(),
    }
}
