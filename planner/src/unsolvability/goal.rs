//! The parts of the goal that never hold.
//!
//! Idea: a conjunct is refuted if the oracle or an interval denies it; a disjunction if all its parts are refuted; a
//! universal part if one instance is refuted. An existential part is refuted as a whole, with open variables, or by
//! refuting each of its instances. Cost: bounded instances.

use super::oracle::Oracle;
use super::reasons::Reasons;
use super::record::{MOST, Never, Part};
use crate::ids::{FactId, id32};
use analysis::intervals::{Ranges, Reachable};
use analysis::{Binding, Compared, Literal};
use pddl::model::{Condition, ConditionKind, ObjectId, VariableId};

/// The most instances of a quantified part that are checked.
const INSTANCES: usize = 1_000;

pub(super) struct Walk<'a> {
    pub(super) oracle: &'a Oracle<'a>,
    pub(super) ranges: &'a Ranges<'a>,
}

impl<'a> Walk<'a> {
    fn binding(&self) -> Binding<'a> {
        Binding::new(&self.oracle.instance.problem.goal_variables)
    }

    /// The conjuncts that never hold.
    pub(super) fn parts(&self, reasons: &mut Reasons<'_>) -> Vec<Part> {
        // A part may turn out to be possible after some of its literals were noted; those must not be reported.
        let mut noted = reasons.without_nodes();
        let mut found = Vec::new();
        let goal = &self.oracle.instance.problem.goal;
        self.conjuncts(goal, true, &mut |part, positive| {
            if let Some(never) = self.refuted(part, positive, &mut self.binding(), &mut noted) {
                found.push(Part { span: part.span, never });
            }
        });
        found.truncate(MOST);
        for never in found.iter_mut().flat_map(|part| &mut part.never) {
            if let Never::Literal(id) = never {
                *id = reasons.of(noted.wanted(*id));
            }
        }
        found
    }

    /// Facts that are true in every state that satisfies the goal.
    pub(super) fn required(&self) -> Vec<FactId> {
        let mut found = Vec::new();
        let binding = self.binding();
        self.conjuncts(&self.oracle.instance.problem.goal, true, &mut |part, positive| {
            if let (ConditionKind::Atom(atom), true) = (&part.kind, positive) {
                let arguments: Result<Vec<_>, _> = binding.pattern(atom).arguments.into_iter().collect();
                found.extend(arguments.ok().and_then(|a| self.oracle.task.fact(atom.predicate, &a)));
            }
        });
        found
    }

    fn conjuncts<'c>(&self, part: &'c Condition, positive: bool, visit: &mut dyn FnMut(&'c Condition, bool)) {
        match (&part.kind, positive) {
            (ConditionKind::And(parts), true) | (ConditionKind::Or(parts), false) => {
                parts.iter().for_each(|part| self.conjuncts(part, positive, visit));
            }
            (ConditionKind::Not(inner), _) => self.conjuncts(inner, !positive, visit),
            _ => visit(part, positive),
        }
    }

    /// The unsatisfiable needs of the part, if it is proven that none of them ever holds; `None`
    /// without a proof.
    fn refuted(
        &self,
        part: &Condition,
        positive: bool,
        binding: &mut Binding<'_>,
        reasons: &mut Reasons<'_>,
    ) -> Option<Vec<Never>> {
        let plain = |is_false: bool| is_false.then(|| vec![Never::Condition(part.span)]);
        match (&part.kind, positive) {
            (ConditionKind::And(parts), true) | (ConditionKind::Or(parts), false) => {
                parts.iter().find_map(|part| self.refuted(part, positive, binding, reasons))
            }
            (ConditionKind::Or(parts), true) | (ConditionKind::And(parts), false) => {
                let each = parts.iter().map(|part| self.refuted(part, positive, binding, reasons));
                let all: Option<Vec<_>> = each.collect();
                let all: Vec<Never> = all?.into_iter().flatten().collect();
                Some(if all.is_empty() { vec![Never::Condition(part.span)] } else { all })
            }
            (ConditionKind::Not(inner), _) => self.refuted(inner, !positive, binding, reasons),
            (ConditionKind::Imply(if_, then), true) => {
                let mut all = self.refuted(if_, false, binding, reasons)?;
                all.extend(self.refuted(then, true, binding, reasons)?);
                Some(all)
            }
            (ConditionKind::Imply(if_, then), false) => self
                .refuted(if_, true, binding, reasons)
                .or_else(|| self.refuted(then, false, binding, reasons)),
            (ConditionKind::Exists(variables, inner), true)
            | (ConditionKind::Forall(variables, inner), false) => {
                // Try open variables first: that gives one reason for all instances.
                if let Some(never) = self.refuted(inner, positive, binding, reasons) {
                    return Some(never);
                }
                let mut all = Vec::new();
                let every = self.instances(variables, binding, &mut |binding| {
                    let never = self.refuted(inner, positive, binding, reasons);
                    never.map(|never| all.extend(never)).is_some()
                })?;
                every.then_some(if all.is_empty() { vec![Never::Condition(part.span)] } else { all })
            }
            (ConditionKind::Forall(variables, inner), true)
            | (ConditionKind::Exists(variables, inner), false) => {
                let mut found = None;
                self.instances(variables, binding, &mut |binding| {
                    found = self.refuted(inner, positive, binding, reasons);
                    found.is_none()
                });
                found
            }
            (ConditionKind::Atom(atom), _) => {
                let wanted = Literal { pattern: binding.pattern(atom), positive };
                (!self.oracle.may_hold(&wanted)).then(|| vec![Never::Literal(reasons.of(&wanted))])
            }
            (ConditionKind::Same(left, right), _) => {
                let both = (binding.term(*left), binding.term(*right));
                plain(matches!(both, (Ok(left), Ok(right)) if (left == right) != positive))
            }
            (ConditionKind::HasType(term, types), _) => {
                plain(binding.term(*term).is_ok_and(|o| self.oracle.instance.is_of(o, types) != positive))
            }
            (ConditionKind::Compare(comparison, left, right), true) => {
                let compared = Compared { comparison: *comparison, left, right };
                Some(vec![Never::Number(self.ranges.never(&compared, binding)?)])
            }
            (ConditionKind::Compare(..) | ConditionKind::FluentIs(..), _) => None,
        }
    }

    /// Visits instances until `visit` returns `false`. Returns whether it returned `true` for all,
    /// or `None` if there are too many instances.
    fn instances(
        &self,
        variables: &[VariableId],
        binding: &mut Binding<'_>,
        visit: &mut dyn FnMut(&mut Binding<'_>) -> bool,
    ) -> Option<bool> {
        let problem = self.oracle.instance.problem;
        let objects = |v: &VariableId| {
            let types = &binding.variables()[*v].types;
            let all = (0..id32(problem.objects.len())).map(ObjectId);
            all.filter(|&o| self.oracle.instance.is_of(o, types)).collect::<Vec<_>>()
        };
        let ranges: Vec<Vec<ObjectId>> = variables.iter().map(objects).collect();
        let count = ranges.iter().try_fold(1_usize, |n, range| n.checked_mul(range.len()))?;
        if count > INSTANCES {
            return None;
        }
        let mut all = true;
        for number in 0..count {
            let mut rest = number;
            for (&variable, range) in variables.iter().zip(&ranges) {
                binding.set(variable, Some(range[rest % range.len()]));
                rest /= range.len();
            }
            if !visit(binding) {
                all = false;
                break;
            }
        }
        variables.iter().for_each(|&v| binding.set(v, None));
        Some(all)
    }
}
