//! Conditions as alternatives: disjunctive normal form, variables typed.
//!
//! Idea: positive existentials are hoisted; every variable of a schema has a slot of its own, so no variable is
//! captured. Negation stays in place as a part that must have no match. A variable of several types gives one
//! alternative for each type. Cost: exponential in the disjunctions under one conjunction, therefore bounded.

use dsr::TypeId;
use pddl::Span;
use pddl::model::VariableId;

use crate::formula::{Formula, Literal};
use crate::scope::Scope;

/// The most alternatives that one condition may have.
pub const MAX_ALTERNATIVES: usize = 512;

/// Literals that must all hold, and parts that must have no match.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Conjunction {
    /// The variables that are quantified here, each with one type.
    pub variables: Vec<(VariableId, TypeId)>,
    /// The literals that must hold.
    pub literals: Vec<(Literal, Span)>,
    /// The parts that must have no match, each with variables of its own.
    pub without: Vec<Conjunction>,
}

impl Conjunction {
    /// The variables that occur here or in a negated part and are quantified outside, ascending.
    pub fn free(&self) -> Vec<VariableId> {
        let mut found: Vec<VariableId> = self.literals.iter().flat_map(|(l, _)| l.variables()).collect();
        found.extend(self.without.iter().flat_map(Self::free));
        found.retain(|variable| self.variables.iter().all(|(own, _)| own != variable));
        found.sort_unstable();
        found.dedup();
        found
    }

    fn and(&self, other: &Self) -> Self {
        let mut both = self.clone();
        both.variables.extend_from_slice(&other.variables);
        for literal in &other.literals {
            // Distribution repeats literals; keep each of them once.
            if !both.literals.iter().any(|(known, _)| *known == literal.0) {
                both.literals.push(literal.clone());
            }
        }
        both.without.extend_from_slice(&other.without);
        both
    }
}

impl From<&Conjunction> for Formula {
    /// The condition that the conjunction has a match.
    fn from(conjunction: &Conjunction) -> Self {
        let literals =
            conjunction.literals.iter().map(|(literal, span)| Self::Literal(literal.clone(), *span));
        let without = conjunction.without.iter().map(|part| Self::from(part).negated());
        let mut parts: Vec<Self> = literals.chain(without).collect();
        let body = if parts.len() == 1 { parts.remove(0) } else { Self::All(parts) };
        if conjunction.variables.is_empty() {
            return body;
        }
        Self::Some(conjunction.variables.iter().map(|(variable, _)| *variable).collect(), Box::new(body))
    }
}

impl Formula {
    /// The alternatives; `None` if there are more than [`MAX_ALTERNATIVES`].
    pub fn disjuncts(&self, scope: &Scope) -> Option<Vec<Conjunction>> {
        match self {
            Self::Literal(literal, span) => {
                Some(vec![Conjunction { literals: vec![(literal.clone(), *span)], ..Conjunction::default() }])
            }
            Self::All(parts) => {
                let mut product = vec![Conjunction::default()];
                for part in parts {
                    let part = part.disjuncts(scope)?;
                    if product.len() * part.len() > MAX_ALTERNATIVES {
                        return None;
                    }
                    product =
                        product.iter().flat_map(|left| part.iter().map(|right| left.and(right))).collect();
                }
                Some(product)
            }
            Self::Any(parts) => {
                let mut sum = Vec::new();
                for part in parts {
                    sum.extend(part.disjuncts(scope)?);
                    if sum.len() > MAX_ALTERNATIVES {
                        return None;
                    }
                }
                Some(sum)
            }
            Self::Some(variables, part) => {
                let part = part.disjuncts(scope)?;
                let typed = typings(variables, scope)?;
                if part.len() * typed.len() > MAX_ALTERNATIVES {
                    return None;
                }
                let quantified = |inner: &Conjunction, types: &Vec<_>| {
                    Conjunction { variables: types.clone(), ..Conjunction::default() }.and(inner)
                };
                Some(
                    part.iter()
                        .flat_map(|inner| typed.iter().map(|types| quantified(inner, types)))
                        .collect(),
                )
            }
            Self::None(variables, part) => {
                let positive = Self::Some(variables.clone(), part.clone()).disjuncts(scope)?;
                Some(vec![Conjunction { without: positive, ..Conjunction::default() }])
            }
        }
    }
}

/// Every way to give each of the variables one of its types; `None` if there are too many.
pub(crate) fn typings(variables: &[VariableId], scope: &Scope) -> Option<Vec<Vec<(VariableId, TypeId)>>> {
    let mut product = vec![Vec::new()];
    for &variable in variables {
        let types = &scope.slot(variable).types;
        if product.len() * types.len() > MAX_ALTERNATIVES {
            return None;
        }
        product = product
            .iter()
            .flat_map(|typed: &Vec<_>| {
                types.iter().map(|&id| {
                    let mut typed = typed.clone();
                    typed.push((variable, id));
                    typed
                })
            })
            .collect();
    }
    Some(product)
}
