//! Checks and whole conditions under a binding.
//!
//! Invariant: like everything here it errs towards true: a condition that some reachable state
//! satisfies evaluates to true once all reachable rows are in the database.

use std::rc::Rc;

use budget::{Interrupted, Meter};
use pddl::model::{Condition, ConditionKind, Idx, Term, VariableId};

use crate::intervals::Hulls;
use crate::walk::Polarity;

use super::database::{RelationId, Rows};
use super::relax::{Knowledge, expected};
use super::rule::Check;
use super::world::{Range, UNBOUND, World, resolve, with_row};

/// What conditions are evaluated with, beside the rows.
pub(crate) struct Evaluator<'a> {
    pub(crate) world: Rc<World<'a>>,
    pub(crate) hulls: Rc<Hulls>,
    pub(crate) predicates: Vec<RelationId>,
    pub(crate) fluents: Vec<RelationId>,
    pub(crate) known: Vec<Knowledge>,
}

impl Evaluator<'_> {
    /// Whether a side condition may hold.
    pub(crate) fn check(
        &self,
        rows: &Rows,
        check: &Check,
        slots: &[Rc<Range>],
        binding: &mut Vec<u32>,
        meter: &Meter<'_>,
    ) -> Result<bool, Interrupted> {
        Ok(match check {
            Check::Same(a, b) => resolve(*a, binding) == resolve(*b, binding),
            Check::Different(a, b) => {
                let a = resolve(*a, binding);
                a != resolve(*b, binding) || self.world.is_abstract(a)
            }
            Check::Absent(pattern) => {
                !with_row(&pattern.arguments, binding, |row| rows.is_initial(pattern.relation, row))
            }
            Check::Compare(polarity, comparison, sides, _) => {
                let object = |t: Term| Some(resolve(t, binding)).filter(|&o| o != UNBOUND);
                self.hulls.may(expected(*polarity), *comparison, (&sides.0, &sides.1), &object)
            }
            Check::Residual(polarity, condition) => {
                self.holds(rows, condition, *polarity, slots, binding, meter)?
            }
        })
    }

    fn holds(
        &self,
        rows: &Rows,
        condition: &Condition,
        polarity: Polarity,
        slots: &[Rc<Range>],
        binding: &mut Vec<u32>,
        meter: &Meter<'_>,
    ) -> Result<bool, Interrupted> {
        meter.spend(1)?;
        let each = |part: &Condition, polarity, binding: &mut Vec<u32>| {
            self.holds(rows, part, polarity, slots, binding, meter)
        };
        match (&condition.kind, polarity) {
            (ConditionKind::And(parts), Polarity::Positive)
            | (ConditionKind::Or(parts), Polarity::Negative) => {
                for part in parts {
                    if !each(part, polarity, binding)? {
                        return Ok(false);
                    }
                }
                Ok(true)
            }
            (ConditionKind::Or(parts), Polarity::Positive)
            | (ConditionKind::And(parts), Polarity::Negative) => {
                for part in parts {
                    if each(part, polarity, binding)? {
                        return Ok(true);
                    }
                }
                Ok(false)
            }
            (ConditionKind::Not(inner), _) => each(inner, polarity.opposite(), binding),
            (ConditionKind::Imply(if_, then), Polarity::Positive) => {
                Ok(each(if_, Polarity::Negative, binding)? || each(then, Polarity::Positive, binding)?)
            }
            (ConditionKind::Imply(if_, then), Polarity::Negative) => {
                Ok(each(if_, Polarity::Positive, binding)? && each(then, Polarity::Negative, binding)?)
            }
            (ConditionKind::Exists(variables, inner), Polarity::Positive)
            | (ConditionKind::Forall(variables, inner), Polarity::Negative) => {
                self.quantified(rows, variables, inner, polarity, true, slots, binding, meter)
            }
            (ConditionKind::Exists(variables, inner), Polarity::Negative)
            | (ConditionKind::Forall(variables, inner), Polarity::Positive) => {
                self.quantified(rows, variables, inner, polarity, false, slots, binding, meter)
            }
            (ConditionKind::Atom(atom), _) => {
                let relation = self.predicates[atom.predicate.index()];
                Ok(with_row(&atom.arguments, binding, |row| self.literal(rows, relation, row, polarity)))
            }
            (ConditionKind::FluentIs(application, value), _) => {
                let relation = self.fluents[application.function.index()];
                let terms = application.arguments.iter().chain([value]);
                let row: Vec<u32> = terms.map(|&t| resolve(t, binding)).collect();
                Ok(self.literal(rows, relation, &row, polarity))
            }
            // Which it is of is not looked at: it may hold.
            (ConditionKind::HasType(..), _) => Ok(true),
            (ConditionKind::Same(a, b), _) => {
                let (a, b) = (resolve(*a, binding), resolve(*b, binding));
                Ok(self.world.is_abstract(a) || (a == b) == (polarity == Polarity::Positive))
            }
            (ConditionKind::Compare(comparison, a, b), _) => {
                let object = |t: Term| Some(resolve(t, binding)).filter(|&o| o != UNBOUND);
                Ok(self.hulls.may(expected(polarity), *comparison, (a, b), &object))
            }
        }
    }

    fn literal(&self, rows: &Rows, relation: RelationId, row: &[u32], polarity: Polarity) -> bool {
        match (self.known[relation.0 as usize], polarity) {
            (Knowledge::Open, _) | (Knowledge::Deletable, Polarity::Negative) => true,
            (_, Polarity::Positive) => rows.find(relation, row).is_some(),
            (Knowledge::Kept, Polarity::Negative) => !rows.is_initial(relation, row),
        }
    }

    #[allow(clippy::too_many_arguments, reason = "one recursion over one condition")]
    fn quantified(
        &self,
        rows: &Rows,
        variables: &[VariableId],
        inner: &Condition,
        polarity: Polarity,
        wanted: bool,
        slots: &[Rc<Range>],
        binding: &mut Vec<u32>,
        meter: &Meter<'_>,
    ) -> Result<bool, Interrupted> {
        let Some((first, rest)) = variables.split_first() else {
            return self.holds(rows, inner, polarity, slots, binding, meter);
        };
        let slot = first.index();
        let before = binding[slot];
        let mut result = !wanted;
        for &object in &slots[slot].objects {
            // No problem: what holds for all of a type may hold for want of objects.
            if !wanted && self.world.is_abstract(object) {
                continue;
            }
            binding[slot] = object;
            if self.quantified(rows, rest, inner, polarity, wanted, slots, binding, meter)? == wanted {
                result = wanted;
                break;
            }
        }
        binding[slot] = before;
        Ok(result)
    }
}
