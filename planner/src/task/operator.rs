//! Ground operators.

use super::blocks::ConditionalEffects;
use super::literals::LiteralsRef;
use super::numeric::NumericEffects;
use super::state::{set, unset};
use crate::ids::FactId;
use pddl::model::{ActionId, ObjectId};

/// A ground operator. Several operators may represent one ground action: one for each way to
/// satisfy a disjunctive or existential precondition.
#[derive(Clone, Copy, Debug)]
pub struct Operator<'a> {
    /// The action schema.
    pub action: ActionId,
    /// The arguments of the schema.
    pub arguments: &'a [ObjectId],
    /// The condition under which it is applicable.
    pub precondition: LiteralsRef<'a>,
    /// Facts that become true.
    pub adds: &'a [FactId],
    /// Facts that become false (disjoint from `adds`).
    pub deletes: &'a [FactId],
    /// The conditional effects.
    pub conditional: ConditionalEffects<'a>,
    /// The effects on numbers.
    pub(crate) numeric: Option<&'a NumericEffects>,
    /// Its cost in units of `1 / Task::cost_scale`.
    pub cost: u32,
}

impl Operator<'_> {
    /// Whether it changes fluents of states.
    pub fn changes_numbers(&self) -> bool {
        self.numeric.is_some_and(|effects| !effects.updates.is_empty())
    }

    /// The number of literals and changes, without conditional effects.
    pub(crate) fn size(&self) -> usize {
        self.precondition.len() + self.adds.len() + self.deletes.len()
    }

    pub(crate) fn apply(&self, state: &[u64], next: &mut [u64]) {
        for &f in self.deletes {
            unset(next, f);
        }
        for effect in self.conditional.iter().filter(|e| e.condition.hold_in(state)) {
            for &f in effect.deletes {
                unset(next, f);
            }
        }
        for &f in self.adds {
            set(next, f);
        }
        for effect in self.conditional.iter().filter(|e| e.condition.hold_in(state)) {
            for &f in effect.adds {
                set(next, f);
            }
        }
    }
}
