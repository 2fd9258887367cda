//! One interval for each function, by a fixpoint with widening.
//!
//! Problem: a numeric condition may never hold, a duration may come out negative, a divisor may always be zero. Idea: a
//! function that nothing changes has exactly its initial values. A function that something changes gets one interval for
//! all its arguments, the hull of its initial values closed under all effects, each as if it could always happen. An
//! `increase` may repeat, so it opens the interval at once. Invariant: every value in every reachable state is in the
//! interval. Cost: a few passes over the effects.
//!
//! Source: Cousot & Cousot, "Abstract interpretation", POPL 1977 (intervals, widening); Scala et al.,
//! "Interval-based relaxation for general numeric planning", ECAI 2016.

use pddl::model::{
    ArithmeticOperator, AssignOperator, AssignedValue, Comparison, Domain, Expression, ExpressionKind,
    FluentValue, FunctionId, FunctionValue, IndexVec, ObjectId, Problem, Term, TimedChange,
};

use super::interval::{End, Interval};
use crate::changes::{Change, changes};
use crate::happening::happenings;
use crate::instance::Values;
use crate::number::Number;

/// Rounds after which a bound that still moves becomes infinite.
const ROUNDS: usize = 4;

/// What is known of one function.
#[derive(Clone, Debug)]
struct Known {
    /// Every value that some application may have; `None` if none has a value.
    hull: Option<Interval>,
    /// Whether something changes it.
    changes: bool,
    /// Whether it changes without an effect at one moment: at a given time, or continuously.
    changes_by_itself: bool,
    /// Whether its initial values are known.
    listed: bool,
}

/// The intervals of all functions.
#[derive(Debug)]
pub struct Hulls {
    functions: IndexVec<FunctionId, Known>,
    /// `None` without a problem.
    values: Option<Values>,
}

/// The values that an expression can have.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Value {
    /// Some number of the interval.
    In(Interval),
    /// It reads a fluent that never has a value.
    Undefined,
}

/// What is asked of a comparison.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Expected {
    /// That it holds.
    Holds,
    /// That it does not.
    Fails,
}

impl Hulls {
    /// The fixpoint from the problem's initial state. Without a problem every number may have any value.
    pub fn new(domain: &Domain, problem: Option<&Problem>) -> Self {
        match problem {
            Some(problem) => Self::from_state(domain, problem, Values::initial(domain, problem)),
            None => {
                let known = Known {
                    hull: Some(Interval::ALL),
                    changes: true,
                    changes_by_itself: true,
                    listed: false,
                };
                Self { functions: domain.functions.iter().map(|_| known.clone()).collect(), values: None }
            }
        }
    }

    /// The fixpoint from any state of the problem.
    pub(super) fn from_state(domain: &Domain, problem: &Problem, values: Values) -> Self {
        let known = |function| {
            let listed = values.is_complete(function);
            let points = values.of(function).map(|(_, value)| Interval::point(value));
            let hull = if listed { points.reduce(Interval::hull) } else { Some(Interval::ALL) };
            Known { hull, changes: false, changes_by_itself: false, listed }
        };
        let mut functions: IndexVec<FunctionId, Known> = domain.functions.ids().map(known).collect();
        for timed in &problem.timed {
            let (function, value) = match &timed.change {
                TimedChange::Assign(fact) => match fact.value {
                    FluentValue::Number(value) => (
                        fact.application.function,
                        Number::from_f64(value).map_or(Interval::ALL, Interval::point),
                    ),
                    FluentValue::Object(_) => continue,
                },
                TimedChange::Undefine(application) => (application.function, Interval::ALL),
                TimedChange::Add(_) | TimedChange::Delete(_) => continue,
            };
            let own = &mut functions[function];
            own.hull = Some(own.hull.map_or(value, |hull| hull.hull(value)));
            (own.changes, own.changes_by_itself) = (true, true);
        }
        let processes = domain.processes.iter().flat_map(|p| &p.effects);
        for change in processes.chain(domain.durative_actions.iter().flat_map(|a| &a.continuous)) {
            let own = &mut functions[change.fluent.function];
            own.hull = Some(Interval::ALL);
            (own.changes, own.changes_by_itself) = (true, true);
        }
        let mut hulls = Self { functions, values: Some(values) };
        hulls.close(domain);
        hulls
    }

    fn close(&mut self, domain: &Domain) {
        let happenings = happenings(domain);
        for round in 0.. {
            let mut moved = false;
            for effect in happenings.iter().flat_map(|h| &h.effects) {
                changes(effect, &mut |_, change| {
                    if let Change::Assign(operator, application, value) = change
                        && domain.functions[application.function].value == FunctionValue::Number
                    {
                        moved |= self.apply(*operator, application.function, value, round);
                    }
                });
            }
            if !moved {
                break;
            }
        }
    }

    fn apply(
        &mut self,
        operator: AssignOperator,
        function: FunctionId,
        value: &AssignedValue,
        round: usize,
    ) -> bool {
        let own = &self.functions[function];
        let (before, changed) = (own.hull, own.changes);
        let with = match value {
            AssignedValue::Number(expression) => match self.hull(expression) {
                Value::In(interval) => interval,
                Value::Undefined => Interval::ALL,
            },
            _ => Interval::ALL,
        };
        let zero = Interval::point(Number::ZERO);
        // Without any value the operators other than `assign` have no meaning, and tools differ.
        let from = before.unwrap_or(Interval::ALL);
        let mut after = match operator {
            AssignOperator::Assign => before.map_or(with, |before| before.hull(with)),
            AssignOperator::Increase | AssignOperator::Decrease => {
                let step = if operator == AssignOperator::Increase { with } else { with.negated() };
                Interval {
                    low: from.low.filter(|_| !step.may(Comparison::Less, zero)),
                    high: from.high.filter(|_| !step.may(Comparison::Greater, zero)),
                }
            }
            AssignOperator::ScaleUp | AssignOperator::ScaleDown => {
                let is_negative = |interval: Interval| interval.may(Comparison::Less, zero);
                let low =
                    Some(End::closed(Number::ZERO)).filter(|_| !is_negative(from) && !is_negative(with));
                Interval { low, high: None }
            }
        };
        if round >= ROUNDS
            && let Some(before) = before
        {
            after = before.hull(after).widened(before);
        }
        let own = &mut self.functions[function];
        own.changes = true;
        own.hull = Some(after);
        before != Some(after) || !changed
    }

    /// Whether something changes the function.
    pub fn changes(&self, function: FunctionId) -> bool {
        self.functions[function].changes
    }

    /// Whether something other than an effect at one moment changes the function.
    pub(super) fn changes_by_itself(&self, function: FunctionId) -> bool {
        self.functions[function].changes_by_itself
    }

    /// Every value that some application of the function may have; `None` if it never has a value.
    pub fn of(&self, function: FunctionId) -> Option<Interval> {
        self.functions[function].hull
    }

    /// Every value that the application to these objects may have; `None` is any object.
    pub(super) fn of_application(
        &self,
        function: FunctionId,
        arguments: &[Option<ObjectId>],
    ) -> Option<Interval> {
        let known = &self.functions[function];
        let hull = known.hull?;
        let Some(values) = self.values.as_ref().filter(|_| known.listed && !known.changes) else {
            return Some(hull);
        };
        if arguments.iter().all(Option::is_none) && !arguments.is_empty() {
            return Some(hull);
        }
        if let Some(objects) = arguments.iter().copied().collect::<Option<Vec<_>>>() {
            return values.get(function, &objects).map(Interval::point);
        }
        let fits = |own: &[ObjectId]| {
            own.iter().zip(arguments).all(|(own, wanted)| wanted.is_none_or(|w| w == *own))
        };
        let values = values.of(function).filter(|(own, _)| fits(own));
        values.map(|(_, value)| Interval::point(value)).reduce(Interval::hull)
    }

    /// The values that the expression can have for any arguments.
    pub fn hull(&self, expression: &Expression) -> Value {
        self.evaluate(expression, &|_| None)
    }

    /// The values that the expression can have for these objects; `None` is any object.
    pub fn evaluate(&self, expression: &Expression, object: &dyn Fn(Term) -> Option<u32>) -> Value {
        let interval = match &expression.kind {
            ExpressionKind::Number(value) => Number::from_f64(*value).map_or(Interval::ALL, Interval::point),
            ExpressionKind::Fluent(application) => {
                let arguments: Vec<Option<ObjectId>> =
                    application.arguments.iter().map(|&term| object(term).map(ObjectId)).collect();
                match self.of_application(application.function, &arguments) {
                    Some(interval) => interval,
                    None => return Value::Undefined,
                }
            }
            ExpressionKind::Arithmetic(operator, operands) => {
                let mut values = Vec::with_capacity(operands.len());
                for operand in operands {
                    match self.evaluate(operand, object) {
                        Value::In(interval) => values.push(interval),
                        Value::Undefined => return Value::Undefined,
                    }
                }
                fold(*operator, &values)
            }
            _ => Interval::ALL,
        };
        Value::In(interval)
    }

    /// Whether the comparison may hold, or fail, for these objects.
    pub fn may(
        &self,
        expected: Expected,
        comparison: Comparison,
        sides: (&Expression, &Expression),
        object: &dyn Fn(Term) -> Option<u32>,
    ) -> bool {
        match (self.evaluate(sides.0, object), self.evaluate(sides.1, object)) {
            (Value::In(left), Value::In(right)) => match expected {
                Expected::Holds => left.may(comparison, right),
                Expected::Fails => left.may_not(comparison, right),
            },
            // A comparison with a fluent that has no value does not hold.
            _ => expected == Expected::Fails,
        }
    }
}

fn fold(operator: ArithmeticOperator, values: &[Interval]) -> Interval {
    let Some((&first, rest)) = values.split_first() else { return Interval::ALL };
    match operator {
        ArithmeticOperator::Subtract if rest.is_empty() => first.negated(),
        ArithmeticOperator::Add => rest.iter().fold(first, |a, &b| a.plus(b)),
        ArithmeticOperator::Subtract => rest.iter().fold(first, |a, &b| a.plus(b.negated())),
        ArithmeticOperator::Multiply => rest.iter().fold(first, |a, &b| a.times(b)),
        ArithmeticOperator::Divide => rest.iter().fold(first, |a, &b| a.over(b)),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::test_support::both;

    const DOMAIN: &str = "(define (domain d) (:requirements :numeric-fluents)
        (:functions (fuel) (left) (steps) (size) (none))
        (:action burn :effect (and (decrease (fuel) (size)) (increase (steps) 1) (assign (left) (fuel)))))";
    const PROBLEM: &str = "(define (problem p) (:domain d)
        (:init (= (fuel) 5) (= (steps) 0) (= (size) 2) (= (left) 9)) (:goal (and)))";

    #[test]
    fn intervals_are_closed_under_effects() {
        let (domain, problem) = both(DOMAIN, PROBLEM);
        let hulls = Hulls::new(&domain, Some(&problem));
        let of = |name: &str| hulls.of(domain.function(name).unwrap());
        let end = |value| Some(End::closed(Number::integer(value)));
        assert_eq!(of("fuel"), Some(Interval { low: None, high: end(5) }));
        assert_eq!(of("steps"), Some(Interval { low: end(0), high: None }));
        assert_eq!(of("left"), Some(Interval { low: None, high: end(9) }));
        assert_eq!(of("size"), Some(Interval::point(Number::integer(2))));
        assert_eq!(of("none"), None);
        assert!(!hulls.changes(domain.function("size").unwrap()));
    }

    #[test]
    fn without_a_problem_every_value_is_possible() {
        let (domain, _) = both(DOMAIN, PROBLEM);
        let hulls = Hulls::new(&domain, None);
        assert_eq!(hulls.of(domain.function("size").unwrap()), Some(Interval::ALL));
    }
}
