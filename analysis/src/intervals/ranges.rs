//! How far single numeric fluents get, and which comparisons therefore never hold.
//!
//! Idea: an interval for each fluent that a comparison depends on, widened until no effect leads out of it. A bound of an
//! effect's result `r` under a condition `g >= 0` is also a bound of `r + c g`, in which what `r` and `g` share cancels
//! out: a load that may not exceed the capacity never does. Invariant: in every reachable state a value lies in its
//! interval. Fluents that are not followed have the interval of their function ([`Hulls`]). Cost: bounded rounds over the
//! effects on the fluents that are followed.
//!
//! Source: interval arithmetic as in Scala, Haslum, Thiébaux & Ramirez, "Interval-based relaxation for general
//! numeric planning", ECAI 2016.

use std::cell::RefCell;
use std::collections::BTreeMap;

use pddl::model::{
    Application, ArithmeticOperator, AssignOperator, AssignedValue, Comparison, ExpressionKind, FunctionId,
    ObjectId,
};

use super::hulls::Hulls;
use super::interval::{End, Interval};
use crate::changes::{Change as EffectChange, Context, changes};
use crate::expression::{Expression, NoValue, Operator};
use crate::happening::{Happening, happenings};
use crate::instance::{Instance, Values};
use crate::literal::{Binding, FluentKey, Literal};
use crate::needs::{Compared, Needs};
use crate::number::Number;

/// Fluents that are followed.
const FLUENTS: usize = 200;
/// Rounds of exact steps; bounds that still move afterwards become infinite.
const ROUNDS: usize = 48;

/// Which literals hold in some reachable state, over-approximated.
pub trait Reachable {
    /// Whether some reachable state may satisfy the literal, for some objects in the place of open arguments; `false` is
    /// proven.
    fn may_hold(&self, literal: &Literal) -> bool;
}

/// A comparison that never holds, and why.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct NeverCompares {
    /// The comparison as PDDL writes it.
    pub comparison: String,
    /// The side of it that changes, or the difference of both.
    pub measured: String,
    /// How far that gets.
    pub extent: Extent,
}

/// How far a number gets in the direction in which it is wanted.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Extent {
    /// It never has a value.
    Undefined,
    /// Never above this.
    AtMost(Number),
    /// Never this or above.
    Below(Number),
    /// Never below this.
    AtLeast(Number),
    /// Never this or below.
    Above(Number),
}

type Sum = Expression<FluentKey>;
type Ground = (FunctionId, Vec<ObjectId>);

/// A difference that is above 0, not below it, or 0.
struct Guard {
    difference: Sum,
    strict: bool,
    equal: bool,
}

/// An effect on one fluent: its result (`None`: any value), and the comparisons that hold just before it.
struct Change {
    result: Option<Sum>,
    guards: Vec<Guard>,
}

/// Intervals of ground fluents, computed when a comparison first asks for them.
pub struct Ranges<'a> {
    instance: Instance<'a>,
    reachable: &'a dyn Reachable,
    happenings: Vec<Happening<'a>>,
    values: Values,
    hulls: Hulls,
    known: RefCell<BTreeMap<Ground, Option<Interval>>>,
}

impl<'a> Ranges<'a> {
    /// From the state with these values; effects that need a literal that is not reachable are left out.
    pub fn new(instance: Instance<'a>, values: &Values, reachable: &'a dyn Reachable) -> Self {
        let Instance { domain, problem } = instance;
        let hulls = Hulls::from_state(domain, problem, values.clone());
        let (happenings, values) = (happenings(domain), values.clone());
        Self { instance, reachable, happenings, values, hulls, known: RefCell::default() }
    }

    /// Why the comparison never holds; `None` if it may.
    pub fn never(&self, compared: &Compared<'_>, binding: &Binding<'_>) -> Option<NeverCompares> {
        let (left, right) = (self.sum(compared.left, binding)?, self.sum(compared.right, binding)?);
        let difference = left.clone().minus(right.clone()).ok()?;
        self.follow(&difference);
        let zero = Interval::point(Number::ZERO);
        let whole = self.interval(&difference);
        if whole.is_some_and(|whole| whole.may(compared.comparison, zero)) {
            return None;
        }
        // The side that changes is reported, where only one does.
        let text = |side| binding.text(side, self.instance);
        let (left_text, right_text) = (text(compared.left), text(compared.right));
        let comparison = format!("({} {left_text} {right_text})", compared.comparison.symbol());
        let (left_range, right_range) = (self.interval(&left), self.interval(&right));
        let (measured, interval, is_right) = if left_range.is_none() || self.is_fixed(&right) {
            (left_text, left_range, false)
        } else if right_range.is_none() || self.is_fixed(&left) {
            (right_text, right_range, true)
        } else {
            (format!("(- {left_text} {right_text})"), whole, false)
        };
        let (Some(whole), Some(interval)) = (whole, interval) else {
            let is_right = right_range.is_none() && left_range.is_some();
            let measured = if is_right { text(compared.right) } else { measured };
            return Some(NeverCompares { comparison, measured, extent: Extent::Undefined });
        };
        let is_too_low =
            !whole.may(Comparison::GreaterEqual, zero) || compared.comparison == Comparison::Greater;
        let extent = match (is_too_low != is_right, interval.high, interval.low) {
            (true, Some(End { value, open: false }), _) => Extent::AtMost(value),
            (true, Some(End { value, open: true }), _) => Extent::Below(value),
            (false, _, Some(End { value, open: false })) => Extent::AtLeast(value),
            (false, _, Some(End { value, open: true })) => Extent::Above(value),
            _ => return None,
        };
        Some(NeverCompares { comparison, measured, extent })
    }

    /// Whether nothing changes the fluents of a sum.
    fn is_fixed(&self, sum: &Sum) -> bool {
        let mut fixed = true;
        sum.each_fluent(&mut |(function, _)| fixed &= !self.hulls.changes(*function));
        fixed
    }

    /// An expression over fluents; `None` where it reads anything else, or has no value.
    fn sum(&self, expression: &pddl::model::Expression, binding: &Binding<'_>) -> Option<Sum> {
        match &expression.kind {
            ExpressionKind::Number(value) => Some(Sum::constant(Number::from_f64(*value)?)),
            ExpressionKind::Fluent(application) => Some(Sum::fluent(binding.fluent(application))),
            ExpressionKind::Arithmetic(operator, parts) => {
                let mut parts = parts.iter().map(|part| self.sum(part, binding));
                let first = parts.next()??;
                let rest: Vec<Sum> = parts.collect::<Option<_>>()?;
                if rest.is_empty() && *operator == ArithmeticOperator::Subtract {
                    return first.negated().ok();
                }
                let joined = |left: Sum, right: Sum| -> Result<Sum, NoValue> {
                    match operator {
                        ArithmeticOperator::Add => left.plus(right),
                        ArithmeticOperator::Subtract => left.minus(right),
                        ArithmeticOperator::Multiply => left.times(right),
                        ArithmeticOperator::Divide => left.over(right),
                    }
                };
                rest.into_iter().try_fold(first, joined).ok()
            }
            _ => None,
        }
    }

    /// Where a sum lies; `None` if some fluent in it never has a value.
    fn interval(&self, sum: &Sum) -> Option<Interval> {
        match sum {
            Sum::Linear(linear) => {
                let mut terms = linear.terms.iter();
                terms.try_fold(Interval::point(linear.constant), |all, (key, coefficient)| {
                    Some(all.plus(self.of(key)?.scaled(*coefficient)))
                })
            }
            Sum::Tree(operator, parts) => {
                let mut parts = parts.iter().map(|part| self.interval(part));
                let first = parts.next().unwrap_or(Some(Interval::point(Number::ZERO)))?;
                parts.try_fold(first, |all, part| {
                    Some(match operator {
                        Operator::Add => all.plus(part?),
                        Operator::Multiply => all.times(part?),
                        Operator::Divide => all.over(part?),
                    })
                })
            }
        }
    }

    fn of(&self, (function, arguments): &FluentKey) -> Option<Interval> {
        let objects: Vec<Option<ObjectId>> = arguments.iter().map(|argument| argument.ok()).collect();
        if self.is_followed(*function)
            && let Some(objects) = objects.iter().copied().collect::<Option<Vec<_>>>()
            && let Some(known) = self.known.borrow().get(&(*function, objects))
        {
            return *known;
        }
        self.hulls.of_application(*function, &objects)
    }

    /// Whether fluents of the function change by effects alone, from values that are known.
    fn is_followed(&self, function: FunctionId) -> bool {
        self.hulls.changes(function)
            && !self.hulls.changes_by_itself(function)
            && self.values.is_complete(function)
    }

    /// Finds the intervals of the fluents in a sum, and of those that they depend on.
    fn follow(&self, sum: &Sum) {
        let mut changes: BTreeMap<Ground, Vec<Change>> = BTreeMap::new();
        let mut open: Vec<Ground> = self.ground(sum);
        while let Some(fluent) = open.pop() {
            let known = self.known.borrow();
            let is_known = changes.contains_key(&fluent) || known.contains_key(&fluent);
            if is_known || known.len() + changes.len() >= FLUENTS {
                continue;
            }
            drop(known);
            let own = self.changes(&fluent);
            for change in &own {
                let sums = change.result.iter().chain(change.guards.iter().map(|guard| &guard.difference));
                open.extend(sums.flat_map(|sum| self.ground(sum)));
            }
            changes.insert(fluent, own);
        }
        let first =
            |(function, arguments): &Ground| self.values.get(*function, arguments).map(Interval::point);
        self.known.borrow_mut().extend(changes.keys().map(|fluent| (fluent.clone(), first(fluent))));
        // Each end is widened at most once, after the exact rounds.
        for round in 0..ROUNDS + 2 * changes.len() + 2 {
            let mut moved = false;
            for (fluent, own) in &changes {
                let before = self.known.borrow().get(fluent).copied().flatten();
                let results = own.iter().filter_map(|change| self.result(change));
                let mut now = results.chain(before).reduce(Interval::hull);
                if round >= ROUNDS && now != before {
                    now = now.map(|now| before.map_or(Interval::ALL, |before| now.widened(before)));
                }
                if now != before {
                    moved = true;
                    self.known.borrow_mut().insert(fluent.clone(), now);
                }
            }
            if !moved {
                return;
            }
        }
        // Never reached: ends are finite in number, and each moves at most once after the exact rounds.
        self.known.borrow_mut().extend(changes.into_keys().map(|fluent| (fluent, Some(Interval::ALL))));
    }

    /// The fluents of a sum that are followed and have no open arguments.
    fn ground(&self, sum: &Sum) -> Vec<Ground> {
        let mut found = Vec::new();
        sum.each_fluent(&mut |(function, arguments)| {
            if self.is_followed(*function)
                && let Ok(arguments) = arguments.iter().copied().collect::<Result<_, _>>()
            {
                found.push((*function, arguments));
            }
        });
        found
    }

    /// Where the result of a change lies; `None` if it never happens, or never gives a value.
    fn result(&self, change: &Change) -> Option<Interval> {
        let Some(result) = &change.result else { return Some(Interval::ALL) };
        let mut interval = self.interval(result)?;
        for guard in &change.guards {
            let own = self.interval(&guard.difference)?;
            let zero = Some(End { value: Number::ZERO, open: guard.strict });
            let wanted = Interval { low: zero, high: zero.filter(|_| guard.equal) };
            if own.intersection(wanted).is_empty() {
                return None;
            }
            for (sum, by) in shifted(result, &guard.difference) {
                let Some(bound) = self.interval(&sum) else { continue };
                // result = shifted - by guard, and guard is not below 0.
                let end = |end: Option<End>| end.map(|e| End { open: e.open || guard.strict, ..e });
                let bound = match (guard.equal, by.sign()) {
                    (true, _) => bound,
                    (false, 1) => Interval { low: None, high: end(bound.high) },
                    (false, -1) => Interval { low: end(bound.low), high: None },
                    _ => continue,
                };
                interval = interval.intersection(bound);
            }
        }
        (!interval.is_empty()).then_some(interval)
    }

    /// The changes of a fluent that may happen.
    fn changes(&self, (function, arguments): &Ground) -> Vec<Change> {
        let mut found = Vec::new();
        for happening in &self.happenings {
            let binding = Binding::new(happening.variables);
            let arguments: Vec<Result<ObjectId, ()>> = arguments.iter().map(|&o| Ok(o)).collect();
            let mut hits = Vec::new();
            for effect in &happening.effects {
                changes(effect, &mut |context, change| {
                    let &EffectChange::Assign(operator, application, value) = change else { return };
                    if application.function == *function
                        && let Some(binding) =
                            binding.unified_terms(&application.arguments, &arguments, self.instance)
                    {
                        hits.push((Hit { operator, application, value, context: context.clone() }, binding));
                    }
                });
            }
            // Several changes at once add up, and a guard speaks of the state before all of them.
            let alone = matches!(hits.as_slice(), [(hit, _)] if hit.context.forall.is_empty());
            for (hit, binding) in &hits {
                let when = hit.context.when.iter().copied();
                let needs = Needs::of(
                    happening.conditions.iter().copied().chain(when.clone()),
                    binding,
                    self.instance,
                );
                if needs.is_false || !needs.literals.iter().all(|literal| self.reachable.may_hold(literal)) {
                    continue;
                }
                let before =
                    Needs::of(happening.just_before.iter().copied().chain(when), binding, self.instance);
                found.extend(self.change(hit, binding, &before.comparisons, alone));
            }
        }
        found
    }

    fn change(
        &self,
        hit: &Hit<'_>,
        binding: &Binding<'_>,
        comparisons: &[Compared<'_>],
        alone: bool,
    ) -> Option<Change> {
        let AssignedValue::Number(value) = hit.value else { return None };
        let own = Sum::fluent(binding.fluent(hit.application));
        let result = self.sum(value, binding).and_then(|value| match hit.operator {
            AssignOperator::Assign => Some(value),
            AssignOperator::Increase => own.plus(value).ok(),
            AssignOperator::Decrease => own.minus(value).ok(),
            AssignOperator::ScaleUp => own.times(value).ok(),
            AssignOperator::ScaleDown => own.over(value).ok(),
        });
        let guard = |compared: &Compared<'_>| {
            let (left, right) = (self.sum(compared.left, binding)?, self.sum(compared.right, binding)?);
            let (difference, strict, equal) = match compared.comparison {
                Comparison::Less => (right.minus(left), true, false),
                Comparison::LessEqual => (right.minus(left), false, false),
                Comparison::Equal => (left.minus(right), false, true),
                Comparison::GreaterEqual => (left.minus(right), false, false),
                Comparison::Greater => (left.minus(right), true, false),
            };
            Some(Guard { difference: difference.ok()?, strict, equal })
        };
        let guards = if alone { comparisons.iter().filter_map(guard).collect() } else { Vec::new() };
        Some(Change { result, guards })
    }
}

/// `result + c guard` for each `c` with which one fluent cancels out, and that `c`.
fn shifted(result: &Sum, guard: &Sum) -> Vec<(Sum, Number)> {
    let (Sum::Linear(own), Sum::Linear(other)) = (result, guard) else { return Vec::new() };
    let coefficient = |key: &FluentKey| own.terms.iter().find(|(own, _)| own == key).map(|(_, c)| *c);
    let shift = |(key, in_guard): &(FluentKey, Number)| {
        let by = coefficient(key)?.times(in_guard.inverse()?)?.negated()?;
        let sum = result.clone().plus(guard.clone().times(Sum::constant(by)).ok()?).ok()?;
        Some((sum, by))
    };
    other.terms.iter().filter_map(shift).collect()
}

/// A change of a fluent in an effect.
struct Hit<'e> {
    operator: AssignOperator,
    application: &'e Application,
    value: &'e AssignedValue,
    /// Below a quantifier it may happen several times at once.
    context: Context<'e>,
}
