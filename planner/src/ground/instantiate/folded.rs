//! Formulas under a binding: constants folded, quantifiers expanded.

use crate::ground::literal::Lit;
use crate::ground::normalise::{Fluents, Key};
use crate::number::{Expression, Relation};
use pddl::model::Expression as Written;

/// A folded formula.
#[derive(Clone, Debug)]
pub(crate) enum Ground {
    True,
    False,
    Literal(Lit),
    /// A conjunction of literals. Most conditions are one, so they need no vector of formulas.
    Conjunction(Vec<Lit>),
    And(Vec<Ground>),
    Or(Vec<Ground>),
    /// A comparison, or its negation.
    Compare(Box<Comparison<Key>>),
}

/// An expression in a relation to 0.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub(crate) struct Comparison<V> {
    pub(crate) relation: Relation,
    pub(crate) expression: Expression<V>,
}

impl Comparison<Key> {
    pub(crate) fn fold(
        relation: Relation,
        left: &Written,
        right: &Written,
        fluents: &Fluents,
        binding: &[u32],
    ) -> Ground {
        let Ok(expression) = fluents.difference(left, right, binding) else { return Ground::False };
        match expression.as_constant() {
            Some(value) if relation.holds(value.sign()) => Ground::True,
            Some(_) => Ground::False,
            None => Ground::Compare(Box::new(Self { relation, expression })),
        }
    }
}

/// The connective that joins the parts of a formula.
#[derive(Clone, Copy)]
pub(super) enum Connective {
    And,
    Or,
}

/// Folds the parts: drops neutral ones, stops at an absorbing one, and flattens nested formulas of
/// the same connective.
pub(super) fn fold_parts<T>(
    connective: Connective,
    parts: impl Iterator<Item = T>,
    fold: impl Fn(T, &mut [u32]) -> Ground,
    binding: &mut [u32],
) -> Ground {
    use Connective::{And, Or};
    let mut kept = Vec::new();
    for part in parts {
        match (connective, fold(part, binding)) {
            (And, Ground::True) | (Or, Ground::False) => {}
            (And, Ground::False) => return Ground::False,
            (Or, Ground::True) => return Ground::True,
            (And, Ground::Conjunction(inner)) => kept.extend(inner.into_iter().map(Ground::Literal)),
            (And, Ground::And(inner)) | (Or, Ground::Or(inner)) => kept.extend(inner),
            (_, other) => kept.push(other),
        }
    }
    match (connective, kept.len()) {
        (And, 0) => Ground::True,
        (Or, 0) => Ground::False,
        (_, 1) => kept.remove(0),
        (And, _) => Ground::And(kept),
        (Or, _) => Ground::Or(kept),
    }
}
