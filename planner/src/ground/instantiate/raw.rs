//! The raw task: every instance of every schema, over atoms of the table, before pruning.

use super::numbers::Numbers;
use crate::ground::literal::Lit;
use crate::ground::normalise::Formula;
use crate::ids::id32;
use crate::number::{Change, Expression};
use crate::task::Rows;
use pddl::model::{ActionId, Objective};

/// Atoms that become true, and atoms that become false.
#[derive(Clone, Debug, Default)]
pub(crate) struct RawEffects {
    pub(crate) adds: Vec<u32>,
    pub(crate) deletes: Vec<u32>,
}

/// An operator over atoms of the table.
#[derive(Clone, Copy)]
pub(crate) struct RawOperator<'r> {
    pub(crate) action: ActionId,
    pub(crate) arguments: &'r [u32],
    pub(crate) precondition: &'r [Lit],
    pub(crate) adds: &'r [u32],
    pub(crate) deletes: &'r [u32],
    /// The range of its conditional effects.
    pub(crate) conditional: (u32, u32),
    pub(crate) cost: f64,
    pub(crate) numbers: &'r [RawChange],
}

/// All operators, with their parts in shared vectors like `Operators`, which is built from them.
#[derive(Default)]
pub(crate) struct RawOperators {
    pub(super) actions: Vec<ActionId>,
    pub(super) arguments: Rows,
    pub(crate) preconditions: Rows,
    pub(super) adds: Rows,
    pub(super) deletes: Rows,
    pub(super) conditional_ends: Vec<u32>,
    pub(super) conditions: Rows,
    pub(super) conditional_adds: Rows,
    pub(super) conditional_deletes: Rows,
    pub(super) costs: Vec<f64>,
    pub(super) number_ends: Vec<u32>,
    pub(super) numbers: Vec<RawChange>,
}

/// A conditional effect: its condition, adds and deletes.
type RawConditional<'r> = (&'r [Lit], &'r [u32], &'r [u32]);

impl RawOperators {
    pub(crate) fn len(&self) -> usize {
        self.actions.len()
    }

    pub(crate) fn get(&self, operator: u32) -> RawOperator<'_> {
        let i = operator as usize;
        let range = |ends: &[u32]| (if i == 0 { 0 } else { ends[i - 1] }, ends[i]);
        let numbers = range(&self.number_ends);
        RawOperator {
            action: self.actions[i],
            arguments: self.arguments.row(operator),
            precondition: self.preconditions.row(operator),
            adds: self.adds.row(operator),
            deletes: self.deletes.row(operator),
            conditional: range(&self.conditional_ends),
            cost: self.costs[i],
            numbers: &self.numbers[numbers.0 as usize..numbers.1 as usize],
        }
    }

    pub(crate) fn iter(&self) -> impl Iterator<Item = RawOperator<'_>> {
        (0..id32(self.len())).map(|i| self.get(i))
    }

    pub(crate) fn conditional<'r>(
        &'r self,
        of: &RawOperator<'_>,
    ) -> impl ExactSizeIterator<Item = RawConditional<'r>> + Clone {
        let (first, end) = of.conditional;
        (first as usize..end as usize)
            .map(id32)
            .map(|i| (self.conditions.row(i), self.conditional_adds.row(i), self.conditional_deletes.row(i)))
    }

    /// The number of literals and changes of an operator, including conditional effects.
    pub(crate) fn size(&self, of: &RawOperator<'_>) -> usize {
        let conditional: usize = self.conditional(of).map(|(c, a, d)| 4 + c.len() + a.len() + d.len()).sum();
        of.precondition.len() + of.adds.len() + of.deletes.len() + conditional
    }

    /// The units of work to read an operator once.
    pub(crate) fn work(&self, of: &RawOperator<'_>) -> usize {
        128 + 8 * self.size(of) + 256 * of.numbers.len()
    }
}

/// The task before pruning.
pub(crate) struct RawTask {
    pub(crate) operators: RawOperators,
    pub(crate) rules: Vec<(u32, Vec<Lit>)>,
    pub(crate) goal: Vec<Lit>,
    /// The parts of the goal that folded to false.
    pub(crate) refuted: Vec<Formula>,
    /// Two atoms of the goal that exclude each other.
    pub(crate) exclusive: Option<(u32, u32)>,
    /// The number of atoms: those of the table, then auxiliary ones.
    pub(crate) atoms: u32,
    /// Numeric fluents, and comparisons of them among the auxiliary atoms.
    pub(crate) numbers: Numbers,
    /// The metric, if it is not a sum of costs.
    pub(crate) metric: Option<(Objective, Expression<u32>)>,
}

/// A change of a numeric fluent.
#[derive(Clone, Debug)]
pub(crate) struct RawChange {
    pub(crate) condition: Vec<Lit>,
    pub(crate) fluent: u32,
    pub(crate) change: Change,
    /// The new value; `None` makes the fluent undefined.
    pub(crate) value: Option<Expression<u32>>,
}
