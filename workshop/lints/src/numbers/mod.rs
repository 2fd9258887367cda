//! Which values numeric fluents may take: intervals per function, by a fixpoint with widening.
//!
//! Problem: a numeric condition may never hold, a duration may come out negative, a divisor may be
//! zero for ever. Idea: a function that nothing changes has exactly its initial values; one that is
//! changed gets one interval for all its arguments, the hull of its initial values closed under all
//! effects, each as if it could always happen. An `increase` may repeat, so it opens the interval at
//! once. Invariant: every value in every reachable state is in the interval. Cost: a few passes over
//! the effects.
//!
//! Source: Cousot & Cousot, "Abstract interpretation", POPL 1977 (intervals, widening); Scala et al.,
//! "Interval-based relaxation for general numeric planning", ECAI 2016.

mod interval;

use analysis::invariants::{Change, changes};
use pddl::model::{
    ArithmeticOperator, AssignOperator, AssignedValue, Comparison, Domain, Expression, ExpressionKind,
    FluentValue, FunctionId, FunctionValue, IndexVec, Problem, Term, TimedChange,
};
use rustc_hash::FxHashMap;

use crate::happening::happenings;
pub(crate) use interval::Interval;

/// Rounds after which a bound that still moves becomes infinite.
const PATIENCE: usize = 4;

/// What is known of one function.
#[derive(Clone, Debug)]
struct Known {
    /// Every value that some application may have; `None` if none has a value.
    hull: Option<Interval>,
    /// Whether some effect changes it.
    changes: bool,
    /// Whether all values are listed in the problem.
    listed: bool,
}

/// What is known of all functions.
pub(crate) struct Numbers {
    functions: IndexVec<FunctionId, Known>,
    values: FxHashMap<(FunctionId, Box<[u32]>), f64>,
}

/// What an expression may be.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Value {
    /// Some number of the interval.
    In(Interval),
    /// It reads a fluent that never has a value.
    Undefined,
}

impl Numbers {
    /// The fixpoint; without a problem every number may be anything.
    pub(crate) fn new(domain: &Domain, problem: Option<&Problem>) -> Self {
        let unknown = problem.is_none();
        let hull = unknown.then_some(Interval::ALL);
        let known = |_| Known { hull, changes: unknown, listed: !unknown };
        let functions = domain.functions.ids().map(known).collect();
        let mut numbers = Self { functions, values: FxHashMap::default() };
        let Some(problem) = problem else { return numbers };
        for fact in &problem.fluents {
            if let FluentValue::Number(value) = fact.value {
                let own = &mut numbers.functions[fact.application.function];
                own.hull = Some(own.hull.map_or(Interval::point(value), |h| h.hull(Interval::point(value))));
                let arguments = fact.application.arguments.iter().map(|o| o.0).collect();
                numbers.values.insert((fact.application.function, arguments), value);
            }
        }
        for timed in &problem.timed {
            let (function, value) = match &timed.change {
                TimedChange::Assign(fact) => match fact.value {
                    FluentValue::Number(value) => (fact.application.function, Interval::point(value)),
                    FluentValue::Object(_) => continue,
                },
                TimedChange::Undefine(application) => (application.function, Interval::ALL),
                TimedChange::Add(_) | TimedChange::Delete(_) => continue,
            };
            let own = &mut numbers.functions[function];
            own.hull = Some(own.hull.map_or(value, |h| h.hull(value)));
            own.changes = true;
        }
        let processes = domain.processes.iter().flat_map(|p| &p.effects);
        for change in processes.chain(domain.durative_actions.iter().flat_map(|a| &a.continuous)) {
            let own = &mut numbers.functions[change.fluent.function];
            own.hull = Some(Interval::ALL);
            own.changes = true;
        }
        numbers.close(domain);
        numbers
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
        let (infinite, none) = (f64::INFINITY, f64::NEG_INFINITY);
        // Without any value the operators other than `assign` have no meaning; tools differ.
        let from = before.unwrap_or(Interval::ALL);
        let mut after = match operator {
            AssignOperator::Assign => before.map_or(with, |b| b.hull(with)),
            AssignOperator::Increase | AssignOperator::Decrease => {
                let step = if operator == AssignOperator::Increase { with } else { with.negate() };
                Interval {
                    low: if step.low < 0.0 { none } else { from.low },
                    high: if step.high > 0.0 { infinite } else { from.high },
                }
            }
            AssignOperator::ScaleUp | AssignOperator::ScaleDown => {
                if from.low >= 0.0 && with.low >= 0.0 {
                    Interval { low: 0.0, high: infinite }
                } else {
                    Interval::ALL
                }
            }
        };
        if round >= PATIENCE
            && let Some(before) = before
        {
            after.low = if after.low < before.low { none } else { after.low };
            after.high = if after.high > before.high { infinite } else { after.high };
        }
        let own = &mut self.functions[function];
        own.changes = true;
        own.hull = Some(after);
        before != Some(after) || !changed
    }

    /// Whether some effect changes the function.
    pub(crate) fn changes(&self, function: FunctionId) -> bool {
        self.functions[function].changes
    }

    /// Every value that some application of the function may have.
    pub(crate) fn of(&self, function: FunctionId) -> Option<Interval> {
        self.functions[function].hull
    }

    /// What the expression may be for any arguments.
    pub(crate) fn hull(&self, expression: &Expression) -> Value {
        self.evaluate(expression, &|_| None)
    }

    /// What the expression may be for these objects; `None` is any object.
    pub(crate) fn evaluate(&self, expression: &Expression, object: &dyn Fn(Term) -> Option<u32>) -> Value {
        let interval = match &expression.kind {
            ExpressionKind::Number(value) => Interval::point(*value),
            ExpressionKind::Fluent(application) => {
                let known = &self.functions[application.function];
                let arguments: Option<Box<[u32]>> =
                    application.arguments.iter().map(|&t| object(t)).collect();
                match (known.hull, arguments) {
                    (None, _) => return Value::Undefined,
                    (Some(_), Some(arguments)) if known.listed && !known.changes => {
                        match self.values.get(&(application.function, arguments)) {
                            Some(&value) => Interval::point(value),
                            None => return Value::Undefined,
                        }
                    }
                    (Some(hull), _) => hull,
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
    pub(crate) fn may(
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

/// What is asked of a comparison.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Expected {
    /// It holds.
    Holds,
    /// It does not.
    Fails,
}

fn fold(operator: ArithmeticOperator, values: &[Interval]) -> Interval {
    let Some((&first, rest)) = values.split_first() else { return Interval::ALL };
    match operator {
        ArithmeticOperator::Subtract if rest.is_empty() => first.negate(),
        ArithmeticOperator::Add => rest.iter().fold(first, |a, &b| a.add(b)),
        ArithmeticOperator::Subtract => rest.iter().fold(first, |a, &b| a.add(b.negate())),
        ArithmeticOperator::Multiply => rest.iter().fold(first, |a, &b| a.multiply(b)),
        ArithmeticOperator::Divide => rest.iter().fold(first, |a, &b| a.divide(b)),
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
        let numbers = Numbers::new(&domain, Some(&problem));
        let of = |name: &str| numbers.of(domain.function(name).unwrap());
        assert_eq!(of("fuel"), Some(Interval { low: f64::NEG_INFINITY, high: 5.0 }));
        assert_eq!(of("steps"), Some(Interval { low: 0.0, high: f64::INFINITY }));
        assert_eq!(of("left"), Some(Interval { low: f64::NEG_INFINITY, high: 9.0 }));
        assert_eq!(of("size"), Some(Interval::point(2.0)));
        assert_eq!(of("none"), None);
        assert!(!numbers.changes(domain.function("size").unwrap()));
    }

    #[test]
    fn without_a_problem_anything_goes() {
        let (domain, _) = both(DOMAIN, PROBLEM);
        let numbers = Numbers::new(&domain, None);
        assert_eq!(numbers.of(domain.function("size").unwrap()), Some(Interval::ALL));
    }
}
