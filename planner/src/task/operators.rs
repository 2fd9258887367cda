//! All operators of a task, in a few shared arrays.
//!
//! Problem: a million operators that own their parts need five million allocations. These take as
//! long to make and to free as grounding itself, and they scatter the data that a search reads.
//! Idea: one array holds the facts of all operators, another those of conditional effects, and each
//! operator stores where its parts end. [`Operators::get`] returns the parts as slices. Invariant:
//! operators are only added, and parts are stored in the order of operators. Cost: 28 bytes an
//! operator, plus its facts and arguments.

use super::blocks::{Block, Blocks, ConditionalEffects, Ends};
use super::numeric::NumericEffects;
use super::operator::Operator;
use crate::ids::{FactId, OperatorId, id32};
use pddl::model::{ActionId, Idx, ObjectId};

/// The parts of an operator to add.
pub(crate) struct NewOperator<'a> {
    pub(crate) action: ActionId,
    pub(crate) arguments: &'a [ObjectId],
    /// Positive and negative precondition, adds, deletes; each sorted.
    pub(crate) facts: [&'a [FactId]; 4],
    pub(crate) numeric: Option<Box<NumericEffects>>,
}

/// All operators.
#[derive(Clone, Debug, Default)]
pub struct Operators {
    actions: Vec<ActionId>,
    costs: Vec<u32>,
    argument_ends: Vec<u32>,
    arguments: Vec<ObjectId>,
    blocks: Blocks,
    /// By operator: where its conditional effects end; empty if no operator has one.
    conditional_ends: Vec<u32>,
    conditional: Blocks,
    /// Empty if no operator changes numbers.
    numeric: Vec<Option<Box<NumericEffects>>>,
}

impl Operators {
    /// Adds a conditional effect to the operator that is added next.
    pub(crate) fn push_conditional(&mut self, facts: [&[FactId]; 4]) {
        if self.conditional_ends.is_empty() {
            self.conditional_ends.resize(self.len(), 0);
        }
        self.conditional.push(facts);
    }

    /// Adds an operator with cost 1.
    pub(crate) fn push(&mut self, new: NewOperator<'_>) {
        if new.numeric.is_some() && self.numeric.is_empty() {
            self.numeric.resize_with(self.len(), || None);
        }
        if new.numeric.is_some() || !self.numeric.is_empty() {
            self.numeric.push(new.numeric);
        }
        if !self.conditional.ends.is_empty() {
            self.conditional_ends.push(id32(self.conditional.ends.len()));
        }
        self.arguments.extend_from_slice(new.arguments);
        self.argument_ends.push(id32(self.arguments.len()));
        self.blocks.push(new.facts);
        self.actions.push(new.action);
        self.costs.push(1);
    }

    pub(crate) fn set_cost(&mut self, operator: usize, cost: u32) {
        self.costs[operator] = cost;
    }

    pub(crate) fn numeric_mut(&mut self) -> impl Iterator<Item = &mut NumericEffects> {
        self.numeric.iter_mut().filter_map(Option::as_deref_mut)
    }

    /// The number of operators.
    pub fn len(&self) -> usize {
        self.actions.len()
    }

    /// Whether the task has no operators.
    pub fn is_empty(&self) -> bool {
        self.actions.is_empty()
    }

    /// All ids, in order.
    pub fn ids(&self) -> impl ExactSizeIterator<Item = OperatorId> + Clone + use<> {
        (0..self.len()).map(OperatorId::from_index)
    }

    /// One operator.
    pub fn get(&self, operator: OperatorId) -> Operator<'_> {
        let i = operator.index();
        let Block { condition, adds, deletes } = self.blocks.get(i);
        let start = |ends: &[u32]| if i == 0 { 0 } else { ends[i - 1] as usize };
        let conditional = match self.conditional_ends.get(i) {
            None => ConditionalEffects { blocks: &self.conditional, first: 0, end: 0 },
            Some(&end) => ConditionalEffects {
                blocks: &self.conditional,
                first: start(&self.conditional_ends),
                end: end as usize,
            },
        };
        Operator {
            action: self.actions[i],
            arguments: &self.arguments[start(&self.argument_ends)..self.argument_ends[i] as usize],
            precondition: condition,
            adds,
            deletes,
            conditional,
            numeric: self.numeric.get(i).and_then(Option::as_deref),
            cost: self.costs[i],
        }
    }

    /// The cost of an operator.
    pub fn cost(&self, operator: OperatorId) -> u32 {
        self.costs[operator.index()]
    }

    /// Iterates over all operators, in order.
    pub fn iter(&self) -> impl ExactSizeIterator<Item = Operator<'_>> + Clone {
        self.ids().map(|id| self.get(id))
    }

    /// Iterates over all operators with their ids.
    pub fn enumerate(&self) -> impl ExactSizeIterator<Item = (OperatorId, Operator<'_>)> + Clone {
        self.ids().map(|id| (id, self.get(id)))
    }

    /// The bytes that they hold.
    pub(crate) fn memory_bytes(&self) -> usize {
        let blocks = |b: &Blocks| b.ends.capacity() * size_of::<Ends>() + b.facts.capacity() * 4;
        let numbers = |e: &NumericEffects| 200 * (1 + e.updates.len() + e.metric.len());
        self.len() * 12
            + self.arguments.capacity() * 4
            + blocks(&self.blocks)
            + blocks(&self.conditional)
            + self.conditional_ends.capacity() * 4
            + self.numeric.iter().flatten().map(|e| 8 + numbers(e)).sum::<usize>()
    }
}

#[cfg(test)]
mod tests {
    use super::{NewOperator, Operators};
    use crate::ids::FactId;
    use pddl::model::{ActionId, ObjectId};
    use proptest::prelude::*;

    type Lists = [Vec<u32>; 4];

    fn lists() -> impl Strategy<Value = Lists> {
        prop::array::uniform4(prop::collection::vec(0..50_u32, 0..4))
    }

    proptest! {
        #[test]
        fn operators_come_back_as_they_were_added(
            all in prop::collection::vec((lists(), prop::collection::vec(lists(), 0..3), 0..3_u32), 0..12),
        ) {
            let facts = |lists: &Lists| lists.clone().map(|l| l.into_iter().map(FactId).collect::<Vec<_>>());
            let mut operators = Operators::default();
            for (own, conditional, arguments) in &all {
                for effect in conditional {
                    let facts = facts(effect);
                    operators.push_conditional([&facts[0], &facts[1], &facts[2], &facts[3]]);
                }
                let (facts, arguments) = (facts(own), (0..*arguments).map(ObjectId).collect::<Vec<_>>());
                let facts = [&facts[0][..], &facts[1], &facts[2], &facts[3]];
                let (action, arguments) = (ActionId(7), &arguments[..]);
                operators.push(NewOperator { action, arguments, facts, numeric: None });
            }
            prop_assert_eq!(operators.len(), all.len());
            for ((id, operator), (own, conditional, arguments)) in operators.enumerate().zip(&all) {
                let same = |a: &[FactId], b: &[FactId]| a == b;
                let wanted = facts(own);
                prop_assert!(same(operator.precondition.positive, &wanted[0]));
                prop_assert!(same(operator.precondition.negative, &wanted[1]));
                prop_assert!(same(operator.adds, &wanted[2]) && same(operator.deletes, &wanted[3]));
                prop_assert_eq!(operator.arguments.len(), *arguments as usize);
                prop_assert_eq!(operator.conditional.len(), conditional.len());
                for (effect, wanted) in operator.conditional.iter().zip(conditional) {
                    let wanted = facts(wanted);
                    prop_assert!(same(effect.condition.positive, &wanted[0]));
                    prop_assert!(same(effect.condition.negative, &wanted[1]));
                    prop_assert!(same(effect.adds, &wanted[2]) && same(effect.deletes, &wanted[3]));
                }
                prop_assert_eq!(operators.cost(id), 1);
            }
        }
    }
}
