//! What a condition certainly needs, under a binding of some of its variables.

use pddl::model::{Comparison, Condition, ConditionKind, Expression, Term};

use crate::instance::Instance;
use crate::literal::{Binding, Literal};

/// A comparison that must hold.
#[derive(Clone, Copy, Debug)]
pub struct Compared<'a> {
    /// How the two sides must compare.
    pub comparison: Comparison,
    /// The left side.
    pub left: &'a Expression,
    /// The right side.
    pub right: &'a Expression,
}

/// Parts of a conjunction.
#[derive(Clone, Debug, Default)]
pub struct Needs<'a> {
    /// Literals that must hold.
    pub literals: Vec<Literal>,
    /// Comparisons that must hold.
    pub comparisons: Vec<Compared<'a>>,
    /// Whether an equality or a type makes the whole false.
    pub is_false: bool,
}

impl<'a> Needs<'a> {
    /// What all of the conditions certainly need.
    pub fn of(
        conditions: impl IntoIterator<Item = &'a Condition>,
        binding: &Binding<'_>,
        instance: Instance<'_>,
    ) -> Self {
        let mut needs = Self::default();
        conditions.into_iter().for_each(|condition| needs.add(condition, true, binding, instance));
        needs
    }

    /// Adds what a condition, or its negation, certainly needs. The parts of disjunctions and what is universally
    /// quantified are left out.
    fn add(
        &mut self,
        condition: &'a Condition,
        positive: bool,
        binding: &Binding<'_>,
        instance: Instance<'_>,
    ) {
        let same = |left: Term, right: Term| match (binding.term(left), binding.term(right)) {
            (Ok(left), Ok(right)) => Some(left == right),
            _ => None,
        };
        match (&condition.kind, positive) {
            (ConditionKind::And(parts), true) | (ConditionKind::Or(parts), false) => {
                parts.iter().for_each(|part| self.add(part, positive, binding, instance));
            }
            (ConditionKind::Not(inner), _) => self.add(inner, !positive, binding, instance),
            (ConditionKind::Imply(if_, then), false) => {
                self.add(if_, true, binding, instance);
                self.add(then, false, binding, instance);
            }
            (ConditionKind::Exists(_, inner), true) | (ConditionKind::Forall(_, inner), false) => {
                self.add(inner, positive, binding, instance);
            }
            (ConditionKind::Atom(atom), _) => {
                self.literals.push(Literal { pattern: binding.pattern(atom), positive });
            }
            (ConditionKind::Same(left, right), _) => {
                self.is_false |= same(*left, *right).is_some_and(|same| same != positive);
            }
            (ConditionKind::HasType(term, types), _) => {
                self.is_false |= binding.term(*term).is_ok_and(|o| instance.is_of(o, types) != positive);
            }
            (ConditionKind::Compare(comparison, left, right), true) => {
                self.comparisons.push(Compared { comparison: *comparison, left, right });
            }
            _ => {}
        }
    }
}
