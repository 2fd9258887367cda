//! The operators of each ground action.
//!
//! Grounding makes an operator for each way to satisfy an action's precondition: each disjunct, each
//! witness of `exists`. A step of a plan names the action, so any of these operators carries it out.
//! Cost: a hash of each operator, when a way is first asked for.

use super::Operators;
use crate::ids::OperatorId;
use rustc_hash::FxHashMap;
use std::collections::hash_map::Entry;

/// The operators that share their action and arguments with others.
#[derive(Clone, Debug, Default)]
pub(crate) struct Ways {
    /// By the first operator of such an action: all of them, in order.
    all: FxHashMap<OperatorId, Vec<OperatorId>>,
    /// The first operator of an action, by the others.
    first: FxHashMap<OperatorId, OperatorId>,
}

impl Ways {
    pub(crate) fn of(operators: &Operators) -> Self {
        let mut ways = Self::default();
        let mut known = FxHashMap::default();
        for id in operators.ids() {
            let operator = operators.get(id);
            match known.entry((operator.action, operator.arguments)) {
                Entry::Vacant(new) => {
                    new.insert(id);
                }
                Entry::Occupied(known) => {
                    let first = *known.get();
                    ways.all.entry(first).or_insert_with(|| vec![first]).push(id);
                    ways.first.insert(id, first);
                }
            }
        }
        ways
    }

    /// The operator, then the others of its action and arguments, in order.
    pub(crate) fn get(&self, operator: OperatorId) -> impl Iterator<Item = OperatorId> + '_ {
        let first = self.first.get(&operator).unwrap_or(&operator);
        let all = self.all.get(first).map_or(&[][..], Vec::as_slice);
        std::iter::once(operator).chain(all.iter().copied().filter(move |&other| other != operator))
    }
}
