//! Evaluates conditions.
//!
//! A comparison over an undefined fluent is neither true nor false, and neither is its negation: a
//! condition is satisfied only if it certainly holds. Negation is therefore pushed inwards:
//! [`Scene::satisfied`] asks whether a condition is certainly true or certainly false (`wanted`). A
//! universal condition is checked by looking for a binding that may violate it; only this step
//! inverts [`Strictness`]. An undefined object fluent, by contrast, has the value `undefined` in
//! PDDL 3.1, which differs from every object.
//!
//! Source: Fox & Long, "PDDL2.1", JAIR 2003, §6: comparisons with ⊥ are undefined, "so that enclosing
//! propositions are also undefined and not satisfied in any state"; disjunctions and quantifiers are
//! split before, hence one true disjunct suffices. Kovacs, "BNF definition of PDDL 3.1", 2011.

use crate::evolution;
use crate::number::Number;
use crate::scene::{Binding, Scene};
use crate::value::Value;
use pddl::model::{Comparison, Condition, ConditionKind, Expression};
use std::cmp::Ordering;

/// How to treat an undefined comparison.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Strictness {
    /// It is not satisfied.
    Certain,
    /// It is satisfied, because it is not refuted.
    Possible,
}

impl Strictness {
    fn turned(self) -> Self {
        match self {
            Self::Certain => Self::Possible,
            Self::Possible => Self::Certain,
        }
    }
}

pub(crate) fn compares(comparison: Comparison, left: Number, right: Number) -> bool {
    is_of(comparison, left.cmp(&right))
}

fn is_of(comparison: Comparison, order: Ordering) -> bool {
    match comparison {
        Comparison::Less => order.is_lt(),
        Comparison::LessEqual => order.is_le(),
        Comparison::Equal => order.is_eq(),
        Comparison::GreaterEqual => order.is_ge(),
        Comparison::Greater => order.is_gt(),
    }
}

/// The relative distance below which the order of rounded values is unknown.
const NEARNESS: f64 = 1e-9;

impl Scene<'_> {
    /// The order of two sides, if both have a value.
    fn order(&self, left: &Expression, right: &Expression, binding: &Binding) -> Option<Ordering> {
        let (one, two) = (self.number(left, binding).ok()?, self.number(right, binding).ok()?);
        let order = match &self.state.passage {
            Some(passage) => evolution::order(passage, *self, left, right, binding).unwrap_or_else(|_| {
                self.state.work.mark_undecided();
                Ordering::Equal
            }),
            None => one.cmp(&two),
        };
        if self.state.rounded && order.is_ne() && !(one.is_exact() && two.is_exact()) {
            let (one, two) = (one.to_f64(), two.to_f64());
            if (one - two).abs() <= NEARNESS * one.abs().max(two.abs()).max(1.0) {
                self.state.work.mark_undecided();
            }
        }
        Some(order)
    }

    /// Whether the condition certainly holds.
    pub(crate) fn holds(&self, condition: &Condition, binding: &mut Binding) -> bool {
        self.satisfied(condition, true, Strictness::Certain, binding)
    }

    pub(crate) fn satisfied(
        &self,
        condition: &Condition,
        wanted: bool,
        strictness: Strictness,
        binding: &mut Binding,
    ) -> bool {
        match &condition.kind {
            ConditionKind::And(parts) | ConditionKind::Or(parts) => {
                let conjunction = matches!(condition.kind, ConditionKind::And(_)) == wanted;
                let mut each = parts.iter().map(|part| self.satisfied(part, wanted, strictness, binding));
                if conjunction { each.all(|s| s) } else { each.any(|s| s) }
            }
            ConditionKind::Not(part) => self.satisfied(part, !wanted, strictness, binding),
            ConditionKind::Imply(if_, then) => {
                if wanted {
                    self.satisfied(if_, false, strictness, binding)
                        || self.satisfied(then, true, strictness, binding)
                } else {
                    self.satisfied(if_, true, strictness, binding)
                        && self.satisfied(then, false, strictness, binding)
                }
            }
            ConditionKind::Exists(variables, body) | ConditionKind::Forall(variables, body) => {
                let one_is_enough = matches!(condition.kind, ConditionKind::Exists(..)) == wanted;
                if one_is_enough {
                    self.some_binding(variables, body, wanted, strictness, binding)
                } else {
                    !self.some_binding(variables, body, !wanted, strictness.turned(), binding)
                }
            }
            ConditionKind::Atom(atom) => {
                binding.with_objects(&atom.arguments, |arguments| self.state.holds(atom.predicate, arguments))
                    == wanted
            }
            ConditionKind::HasType(term, types) => {
                self.universe.is_of(binding.object(*term), types) == wanted
            }
            ConditionKind::Same(left, right) => (binding.object(*left) == binding.object(*right)) == wanted,
            ConditionKind::Compare(comparison, left, right) => match self.order(left, right, binding) {
                Some(order) => is_of(*comparison, order) == wanted,
                None => strictness == Strictness::Possible,
            },
            ConditionKind::FluentIs(application, value) => {
                (self.fluent(application, binding) == Some(Value::Object(binding.object(*value)))) == wanted
            }
        }
    }
}
