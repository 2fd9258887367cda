//! The condition under which an effect can be seen.
//!
//! Sensed, not asserted: PELEA does not write the end of an action, it waits to see it. An add is seen when the edge
//! exists, a delete when it does not exist, an assignment when the attribute has the value, `undefined` when the
//! attribute has no value. `forall` ranges over the nodes, and `when` evaluates its condition, at the time of looking. An
//! effect that depends on the value before it (`increase`) cannot be awaited.

use dsr::Comparison;
use pddl::model::{self, EffectKind};

use crate::effect::{Change, Given};
use crate::formula::{Formula, Literal, Right};
use crate::link_error::{LinkError, LinkErrorKind};
use crate::lower_effect::{assignment, constant, edge};
use crate::scope::Scope;
use crate::tokens::Tokens;
use crate::translate::{Derived, Translator};

pub(crate) fn formula<'c>(
    tokens: &Tokens,
    domain: &model::Domain,
    scope: &Scope,
    effects: impl IntoIterator<Item = &'c model::Effect>,
) -> Result<Formula, Vec<LinkError>> {
    let mut translator = Translator::new(tokens, domain, scope, Derived::Refused);
    let all = Formula::All(effects.into_iter().map(|effect| expected(&mut translator, effect)).collect());
    let parts: Vec<Formula> = all.conjuncts().into_iter().cloned().collect();
    // An add of the same token wins over its delete.
    let overruled = |part: &Formula| matches!(part, Formula::None(variables, denied) if variables.is_empty() && parts.iter().any(|added| same(added, denied)));
    let seen = parts.iter().filter(|part| !overruled(part)).cloned().collect();
    translator.finish(Formula::All(seen))
}

fn same(a: &Formula, b: &Formula) -> bool {
    matches!((a, b), (Formula::Literal(a, _), Formula::Literal(b, _)) if a == b)
}

fn expected(translator: &mut Translator<'_>, effect: &model::Effect) -> Formula {
    let span = effect.span;
    match &effect.kind {
        EffectKind::And(parts) => Formula::All(parts.iter().map(|part| expected(translator, part)).collect()),
        EffectKind::Forall(variables, part) => {
            let variables = translator.quantified(variables, span);
            Formula::None(variables, Box::new(expected(translator, part).negated()))
        }
        EffectKind::When(condition, part) => {
            let guard = translator.condition(condition).negated();
            Formula::Any(vec![guard, expected(translator, part)])
        }
        EffectKind::Add(atom) | EffectKind::Delete(atom) => {
            let Some((from, label, to)) = edge(translator, atom) else { return Formula::always() };
            let seen = Formula::Literal(Literal::Edge { from, label, to }, span);
            if matches!(effect.kind, EffectKind::Add(_)) { seen } else { seen.negated() }
        }
        EffectKind::Assign(operator, application, value) => {
            let Some(change) = assignment(translator, *operator, application, value, span) else {
                return Formula::always();
            };
            let right = match &change {
                Change::Clear { holder, attribute } => {
                    let (holder, attribute) = (holder.clone(), *attribute);
                    return Formula::Literal(Literal::Present { holder, attribute }, span).negated();
                }
                Change::Set { given: Given::Value(value), .. } => Some(Right::Value(value.clone())),
                Change::Set { given: Given::Node(node), .. } => Some(Right::Term(node.clone())),
                Change::Set { given: Given::Number(number), .. } => constant(number).map(Right::Value),
                _ => None,
            };
            match (change, right) {
                (Change::Set { holder, attribute, .. }, Some(right)) => {
                    let comparison = Comparison::Equal;
                    Formula::Literal(Literal::Compare { holder, attribute, comparison, right }, span)
                }
                _ => {
                    translator.error(span, LinkErrorKind::NotExpectable);
                    Formula::always()
                }
            }
        }
    }
}
