//! How large numeric fluents ever get, and which comparisons therefore never hold.
//!
//! Idea: an interval for each fluent that matters, widened until no effect leads out of it. A bound of
//! an effect's result `r` under a guard `g >= 0` is also a bound of `r + c g`, in which what `r` and `g` share
//! cancels out: a load that may not exceed the capacity never does. Invariant: in every reachable state a value
//! lies in its interval (intervals of exact numbers, with open ends). What is not followed (products of fluents,
//! scaling) has no bounds. Cost: bounded rounds over the effects on the fluents that are looked at.
//!
//! Source: interval arithmetic as in Scala, Haslum, Thiébaux & Ramirez, "Interval-based relaxation for general
//! numeric planning", ECAI 2016.

use super::needs::{Binding, Compared, Needs};
use super::oracle::Oracle;
use crate::number::Number;
use analysis::invariants::{Context, changes};
use pddl::model::{
    Application, ArithmeticOperator, AssignOperator, AssignedValue, Comparison, EffectKind, Expression,
    ExpressionKind, FluentValue, FunctionId, ObjectId, Term,
};
use std::cell::RefCell;
use std::collections::{BTreeMap, BTreeSet};

/// Fluents that are followed; the others have no bounds.
const FLUENTS: usize = 200;
/// Rounds of exact steps; bounds that still move then are given up.
const ROUNDS: usize = 48;

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

/// One end; `None` is infinite.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct End {
    value: Number,
    open: bool,
}

/// All numbers between two ends.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Interval {
    low: Option<End>,
    high: Option<End>,
}

impl Interval {
    const ALL: Self = Self { low: None, high: None };

    fn point(value: Number) -> Self {
        let end = Some(End { value, open: false });
        Self { low: end, high: end }
    }

    fn times(self, by: Number) -> Self {
        let end = |end: Option<End>| end.and_then(|e| Some(End { value: e.value.times(by)?, open: e.open }));
        match by.sign() {
            0 => Self::point(Number::ZERO),
            1 => Self { low: end(self.low), high: end(self.high) },
            _ => Self { low: end(self.high), high: end(self.low) },
        }
    }

    fn plus(self, other: Self) -> Self {
        let sum = |a: Option<End>, b: Option<End>| {
            let (a, b) = (a?, b?);
            Some(End { value: a.value.plus(b.value)?, open: a.open || b.open })
        };
        Self { low: sum(self.low, other.low), high: sum(self.high, other.high) }
    }

    /// The smallest interval around both.
    fn or(self, other: Self) -> Self {
        let pick = |a: Option<End>, b: Option<End>, lowest: bool| {
            let (a, b) = (a?, b?);
            Some(match (a.value == b.value, a.value.is_below(b.value) == lowest) {
                (true, _) => End { open: a.open && b.open, ..a },
                (false, true) => a,
                (false, false) => b,
            })
        };
        Self { low: pick(self.low, other.low, true), high: pick(self.high, other.high, false) }
    }

    /// What both allow.
    fn and(self, other: Self) -> Self {
        let pick = |a: Option<End>, b: Option<End>, highest: bool| match (a, b) {
            (Some(a), Some(b)) if a.value == b.value => Some(End { open: a.open || b.open, ..a }),
            (Some(a), Some(b)) => Some(if b.value.is_below(a.value) == highest { a } else { b }),
            (one, None) | (None, one) => one,
        };
        Self { low: pick(self.low, other.low, true), high: pick(self.high, other.high, false) }
    }

    /// What moved since `before` is no bound any more.
    fn widened(self, before: Self) -> Self {
        let kept = |now: Option<End>, then: Option<End>| now.filter(|_| now == then);
        Self { low: kept(self.low, before.low), high: kept(self.high, before.high) }
    }

    fn is_empty(self) -> bool {
        let (Some(low), Some(high)) = (self.low, self.high) else { return false };
        high.value.is_below(low.value) || (low.value == high.value && (low.open || high.open))
    }
}

/// A fluent of which some arguments may be open: the number of a variable.
type Key = (FunctionId, Vec<Result<ObjectId, u32>>);
type Ground = (FunctionId, Vec<ObjectId>);

/// A weighted sum of fluents.
#[derive(Clone, Debug)]
struct Sum {
    terms: BTreeMap<Key, Number>,
    constant: Number,
}

impl Sum {
    fn constant(constant: Number) -> Self {
        Self { terms: BTreeMap::new(), constant }
    }

    /// `self + by other`; `None` where that takes too long numbers.
    fn plus(mut self, by: Number, other: &Self) -> Option<Self> {
        self.constant = self.constant.plus(other.constant.times(by)?)?;
        for (key, coefficient) in &other.terms {
            let own = self.terms.get(key).copied().unwrap_or(Number::ZERO);
            let sum = own.plus(coefficient.times(by)?)?;
            if sum.is_zero() {
                self.terms.remove(key);
            } else {
                self.terms.insert(key.clone(), sum);
            }
        }
        Some(self)
    }

    fn minus(&self, other: &Self) -> Option<Self> {
        self.clone().plus(Number::integer(-1), other)
    }
}

/// A difference that is above 0, not below it, or 0.
struct Guard {
    sum: Sum,
    strict: bool,
    equal: bool,
}

/// An effect on one fluent: its result (`None`: anything), and what holds before it.
struct Change {
    result: Option<Sum>,
    guards: Vec<Guard>,
}

/// Effects of the model on ground fluents, followed as they are asked for.
pub(super) struct Ranges<'a> {
    oracle: &'a Oracle<'a>,
    initial: BTreeMap<Ground, Number>,
    /// Whether no initial value is missing because it is too long for us.
    is_exact: bool,
    changing: BTreeSet<FunctionId>,
    known: RefCell<BTreeMap<Ground, Option<Interval>>>,
}

impl<'a> Ranges<'a> {
    pub(super) fn new(oracle: &'a Oracle<'a>) -> Self {
        let (mut initial, mut is_exact) = (BTreeMap::new(), true);
        for fluent in &oracle.problem.fluents {
            let FluentValue::Number(value) = fluent.value else { continue };
            let application = &fluent.application;
            match Number::from_f64(value) {
                Some(value) => {
                    initial.insert((application.function, application.arguments.clone()), value);
                }
                None => is_exact = false,
            }
        }
        let state = oracle.query.state;
        is_exact &= state.is_exact();
        for (application, value) in oracle.task.numbers(state) {
            let key = (application.function, application.arguments.clone());
            match value {
                Some(value) => initial.insert(key, value),
                None => initial.remove(&key),
            };
        }
        let mut changing = BTreeSet::new();
        for action in &oracle.domain.actions {
            action.effect.each(&mut |part| {
                if let EffectKind::Assign(_, application, _) = &part.kind {
                    changing.insert(application.function);
                }
            });
        }
        Self { oracle, initial, is_exact, changing, known: RefCell::default() }
    }

    /// Why the comparison never holds; `None` if it may.
    pub(super) fn never(&self, compared: &Compared<'_>, binding: &Binding<'_>) -> Option<NeverCompares> {
        if !self.is_exact {
            return None;
        }
        let (left, right) = (self.sum(compared.left, binding)?, self.sum(compared.right, binding)?);
        let difference = left.minus(&right)?;
        self.follow(&difference);
        let whole = self.interval(&difference);
        let zero = |open: bool| Some(End { value: Number::ZERO, open });
        let (high, low) =
            (Interval { low: None, high: zero(false) }, Interval { low: zero(false), high: None });
        let wanted = match compared.comparison {
            Comparison::Less => Interval { high: zero(true), ..high },
            Comparison::LessEqual => high,
            Comparison::Equal => Interval::point(Number::ZERO),
            Comparison::GreaterEqual => low,
            Comparison::Greater => Interval { low: zero(true), ..low },
        };
        if whole.is_some_and(|whole| !whole.and(wanted).is_empty()) {
            return None;
        }
        // Told of the side that changes, where only one does.
        let (left_text, right_text) = (self.text(compared.left, binding), self.text(compared.right, binding));
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
            let measured = if right_range.is_none() && left_range.is_some() {
                self.text(compared.right, binding)
            } else {
                measured
            };
            return Some(NeverCompares { comparison, measured, extent: Extent::Undefined });
        };
        let is_too_low = whole.and(low).is_empty() || compared.comparison == Comparison::Greater;
        let extent = match (is_too_low != is_right, interval.high, interval.low) {
            (true, Some(End { value, open: false }), _) => Extent::AtMost(value),
            (true, Some(End { value, open: true }), _) => Extent::Below(value),
            (false, _, Some(End { value, open: false })) => Extent::AtLeast(value),
            (false, _, Some(End { value, open: true })) => Extent::Above(value),
            _ => return None,
        };
        Some(NeverCompares { comparison, measured, extent })
    }

    /// Whether no action changes what is in it.
    fn is_fixed(&self, sum: &Sum) -> bool {
        !sum.terms.keys().any(|(function, _)| self.changing.contains(function))
    }

    /// An expression as a sum; `None` where it is none.
    fn sum(&self, expression: &Expression, binding: &Binding<'_>) -> Option<Sum> {
        match &expression.kind {
            ExpressionKind::Number(value) => Some(Sum::constant(Number::from_f64(*value)?)),
            ExpressionKind::Fluent(application) => {
                let key = key(application, binding);
                Some(Sum { terms: BTreeMap::from([(key, Number::ONE)]), constant: Number::ZERO })
            }
            ExpressionKind::Arithmetic(operator, parts) => {
                let mut parts = parts.iter().map(|part| self.sum(part, binding));
                let first = parts.next()??;
                let rest: Vec<Sum> = parts.collect::<Option<_>>()?;
                let nothing = Sum::constant(Number::ZERO);
                match operator {
                    ArithmeticOperator::Add => {
                        rest.iter().try_fold(first, |sum, part| sum.plus(Number::ONE, part))
                    }
                    ArithmeticOperator::Subtract if rest.is_empty() => {
                        nothing.plus(Number::integer(-1), &first)
                    }
                    ArithmeticOperator::Subtract => {
                        rest.iter().try_fold(first, |sum, part| sum.plus(Number::integer(-1), part))
                    }
                    ArithmeticOperator::Multiply => {
                        rest.into_iter().try_fold(first, |product, part| {
                            match (product.terms.is_empty(), part.terms.is_empty()) {
                                (true, _) => Sum::constant(Number::ZERO).plus(product.constant, &part),
                                (_, true) => Sum::constant(Number::ZERO).plus(part.constant, &product),
                                _ => None,
                            }
                        })
                    }
                    ArithmeticOperator::Divide => rest.into_iter().try_fold(first, |quotient, part| {
                        let by = part.terms.is_empty().then(|| part.constant.inverse())??;
                        Sum::constant(Number::ZERO).plus(by, &quotient)
                    }),
                }
            }
            _ => None,
        }
    }

    /// Where a sum lies; `None` if some fluent in it never has a value.
    fn interval(&self, sum: &Sum) -> Option<Interval> {
        sum.terms.iter().try_fold(Interval::point(sum.constant), |all, (key, coefficient)| {
            Some(all.plus(self.of(key)?.times(*coefficient)))
        })
    }

    fn of(&self, key: &Key) -> Option<Interval> {
        let objects: Result<Vec<ObjectId>, _> = key.1.iter().copied().collect();
        if self.changing.contains(&key.0) {
            let Ok(objects) = objects else { return Some(Interval::ALL) };
            let known = self.known.borrow();
            return known.get(&(key.0, objects)).copied().unwrap_or(Some(Interval::ALL));
        }
        if let Ok(objects) = objects {
            return self.initial.get(&(key.0, objects)).map(|&value| Interval::point(value));
        }
        let fits = |arguments: &[ObjectId]| {
            arguments.iter().zip(&key.1).all(|(object, wanted)| wanted.is_err() || *wanted == Ok(*object))
        };
        let values = self.initial.iter().filter(|((f, a), _)| *f == key.0 && fits(a));
        values.map(|(_, &value)| Interval::point(value)).reduce(Interval::or)
    }

    /// Finds the intervals of the fluents in a sum, and of what they depend on.
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
                let sums = change.result.iter().chain(change.guards.iter().map(|guard| &guard.sum));
                open.extend(sums.flat_map(|sum| self.ground(sum)));
            }
            changes.insert(fluent, own);
        }
        let first = |fluent: &Ground| self.initial.get(fluent).map(|&value| Interval::point(value));
        self.known.borrow_mut().extend(changes.keys().map(|fluent| (fluent.clone(), first(fluent))));
        // Each end is widened at most once, after the exact rounds.
        for round in 0..ROUNDS + 2 * changes.len() + 2 {
            let mut moved = false;
            for (fluent, own) in &changes {
                let before = self.known.borrow().get(fluent).copied().flatten();
                let results = own.iter().filter_map(|change| self.result(change));
                let mut now = results.chain(before).reduce(Interval::or);
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

    /// The fluents of a sum that change and have no open arguments.
    fn ground(&self, sum: &Sum) -> Vec<Ground> {
        let changing = sum.terms.keys().filter(|(function, _)| self.changing.contains(function));
        changing
            .filter_map(|(function, arguments)| {
                Some((*function, arguments.iter().copied().collect::<Result<_, _>>().ok()?))
            })
            .collect()
    }

    /// Where the result of a change lies; `None` if it never happens, or never gives a value.
    fn result(&self, change: &Change) -> Option<Interval> {
        let Some(result) = &change.result else { return Some(Interval::ALL) };
        let mut interval = self.interval(result)?;
        for guard in &change.guards {
            let own = self.interval(&guard.sum)?;
            let zero = Some(End { value: Number::ZERO, open: guard.strict });
            let wanted = Interval { low: zero, high: zero.filter(|_| guard.equal) };
            if own.and(wanted).is_empty() {
                return None;
            }
            // One multiple for each fluent that may cancel out, and the guard as it is.
            let ratios = guard.sum.terms.iter().filter_map(|(key, &coefficient)| {
                let ratio = result.terms.get(key)?.times(coefficient.inverse()?)?;
                ratio.negated()
            });
            for by in ratios {
                let Some(shifted) = result.clone().plus(by, &guard.sum) else { continue };
                let Some(bound) = self.interval(&shifted) else { continue };
                // result = shifted - by guard, and guard is not below 0.
                let end = |end: Option<End>| end.map(|e| End { open: e.open || guard.strict, ..e });
                let bound = match (guard.equal, by.sign()) {
                    (true, _) => bound,
                    (false, 1) => Interval { low: None, high: end(bound.high) },
                    (false, -1) => Interval { low: end(bound.low), high: None },
                    _ => continue,
                };
                interval = interval.and(bound);
            }
        }
        (!interval.is_empty()).then_some(interval)
    }

    /// The changes of a fluent that may happen.
    fn changes(&self, fluent: &Ground) -> Vec<Change> {
        let mut found = Vec::new();
        for action in &self.oracle.domain.actions {
            let binding = Binding::new(&action.variables);
            let arguments: Vec<_> = fluent.1.iter().map(|&o| Ok(o)).collect();
            let mut hits = Vec::new();
            changes(&action.effect, &mut |context, change| {
                let &analysis::invariants::Change::Assign(operator, application, value) = change else {
                    return;
                };
                if application.function == fluent.0
                    && let Some(binding) =
                        binding.unified_terms(&application.arguments, &arguments, self.oracle)
                {
                    hits.push((Hit { operator, application, value, context: context.clone() }, binding));
                }
            });
            // Several changes at once add up, and a guard speaks of the state before all of them.
            let alone = matches!(hits.as_slice(), [(hit, _)] if hit.context.forall.is_empty());
            for (hit, binding) in &hits {
                let mut needs = Needs::default();
                needs.add(&action.precondition, true, binding, self.oracle);
                hit.context.when.iter().for_each(|c| needs.add(c, true, binding, self.oracle));
                if needs.is_false || !needs.literals.iter().all(|wanted| self.oracle.may_be(wanted)) {
                    continue;
                }
                found.extend(self.change(hit, binding, &needs, alone));
            }
        }
        found
    }

    fn change(&self, hit: &Hit<'_>, binding: &Binding<'_>, needs: &Needs<'_>, alone: bool) -> Option<Change> {
        let AssignedValue::Number(value) = hit.value else { return None };
        let own = Sum {
            terms: BTreeMap::from([(key(hit.application, binding), Number::ONE)]),
            constant: Number::ZERO,
        };
        let result = self.sum(value, binding).and_then(|value| match hit.operator {
            AssignOperator::Assign => Some(value),
            AssignOperator::Increase => own.plus(Number::ONE, &value),
            AssignOperator::Decrease => own.plus(Number::integer(-1), &value),
            AssignOperator::ScaleUp | AssignOperator::ScaleDown => None,
        });
        let guard = |compared: &Compared<'_>| {
            let sum = self.sum(compared.left, binding)?.minus(&self.sum(compared.right, binding)?)?;
            let negated = || Sum::constant(Number::ZERO).minus(&sum);
            let (sum, strict, equal) = match compared.comparison {
                Comparison::Less => (negated()?, true, false),
                Comparison::LessEqual => (negated()?, false, false),
                Comparison::Equal => (sum, false, true),
                Comparison::GreaterEqual => (sum, false, false),
                Comparison::Greater => (sum, true, false),
            };
            Some(Guard { sum, strict, equal })
        };
        let guards = if alone { needs.comparisons.iter().filter_map(guard).collect() } else { Vec::new() };
        Some(Change { result, guards })
    }

    /// An expression as PDDL writes it.
    fn text(&self, expression: &Expression, binding: &Binding<'_>) -> String {
        let Oracle { domain, problem, .. } = self.oracle;
        match &expression.kind {
            ExpressionKind::Number(value) => value.to_string(),
            ExpressionKind::Fluent(application) => {
                let mut text = format!("({}", domain.functions[application.function].name);
                for &argument in &application.arguments {
                    text.push(' ');
                    match binding.term(argument) {
                        Ok(object) => text.push_str(problem.objects[object].name.as_str()),
                        Err(variable) => {
                            text.push('?');
                            text.push_str(variable.as_str().trim_start_matches('?'));
                        }
                    }
                }
                text + ")"
            }
            ExpressionKind::Arithmetic(operator, parts) => {
                let parts: Vec<String> = parts.iter().map(|part| self.text(part, binding)).collect();
                format!("({} {})", operator.symbol(), parts.join(" "))
            }
            _ => "?".to_owned(),
        }
    }
}

fn key(application: &Application, binding: &Binding<'_>) -> Key {
    let argument = |&term: &Term| match term {
        Term::Object(object) => Ok(object),
        Term::Variable(v) => binding.get(v).ok_or(v.0),
    };
    (application.function, application.arguments.iter().map(argument).collect())
}

/// A change of a fluent in an effect.
struct Hit<'e> {
    operator: AssignOperator,
    application: &'e Application,
    value: &'e AssignedValue,
    /// Below a quantifier it may happen several times at once.
    context: Context<'e>,
}
