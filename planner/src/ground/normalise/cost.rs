//! The metric and the costs of operators.
//!
//! Idea: suppose that a metric minimises a weighted sum of fluents without arguments, and that
//! actions only increase these fluents, by static values and without conditions. Then the metric is
//! a sum of operator costs, which every search supports ([`Measure::Sum`]). A common power of ten
//! makes these costs integers. Without a metric, or if no action changes it, every action costs 1.
//! Any other metric (a maximised one, for instance) is evaluated along a plan ([`Measure::Value`]).
//! An operator then costs what it adds to the metric in the initial state, at least 0; that guides
//! a search and proves nothing.

use super::fluents::Fluents;
use crate::number::Number;
use pddl::Span;
use pddl::model::{
    Application, ArithmeticOperator, AssignOperator, AssignedValue, Domain, Effect, EffectKind, Expression,
    ExpressionKind, FunctionId, Metric, Objective, Problem,
};
use rustc_hash::FxHashMap;

/// A weighted increase.
#[derive(Clone, Debug)]
pub(crate) struct CostTerm {
    weight: Number,
    expression: Expression,
}

/// The measure of the quality of plans.
#[derive(Clone, Debug)]
pub(crate) enum Measure {
    /// The length of the plan.
    Length,
    /// The sum of the operators' costs: the weight of each fluent that the metric reads, and the
    /// weight of each step.
    Sum { weights: FxHashMap<FunctionId, Number>, step: Number },
    /// The metric's value at the end of the plan.
    Value(Metric),
}

/// The cost model of a task.
pub(crate) struct CostModel {
    pub(crate) measure: Measure,
}

/// The reason why an operator has no cost.
pub(crate) enum NoCost {
    /// It has no result, so it can never be applied.
    Inapplicable,
    /// It improves the metric.
    Negative,
}

impl CostModel {
    /// `additive`: whether to try a sum of operator costs.
    pub(crate) fn new(domain: &Domain, problem: &Problem, fluents: &Fluents, additive: bool) -> Self {
        let Some(metric) = &problem.metric else { return Self { measure: Measure::Length } };
        let sign = if metric.objective == Objective::Minimize { 1 } else { -1 };
        let mut sum = WeightedSum::default();
        let linear = sum.add(&metric.expression, Number::integer(sign)).is_some();
        sum.weights.retain(|f, w| !w.is_zero() && fluents.changes(*f));
        let value = Self { measure: Measure::Value(metric.clone()) };
        if !linear || !additive || sum.step.sign() < 0 {
            return value;
        }
        if sum.weights.is_empty() {
            // A metric that no action changes, or `total-time` alone: the length of the plan.
            return Self { measure: Measure::Length };
        }
        let sums = domain.actions.iter().all(|a| only_adds(&a.effect, true, &sum.weights, fluents));
        if sums { Self { measure: Measure::Sum { weights: sum.weights, step: sum.step } } } else { value }
    }

    /// The term that a numeric effect adds to the operator's cost.
    pub(crate) fn term(
        &self,
        operator: AssignOperator,
        application: &Application,
        value: &AssignedValue,
    ) -> Option<CostTerm> {
        let Measure::Sum { weights, .. } = &self.measure else { return None };
        let weight = *weights.get(&application.function)?;
        let AssignedValue::Number(expression) = value else { return None };
        let weight = if operator == AssignOperator::Decrease { weight.negated()? } else { weight };
        Some(CostTerm { weight, expression: expression.clone() })
    }

    /// Whether each action costs 1.
    pub(crate) fn is_unit(&self) -> bool {
        matches!(self.measure, Measure::Length)
    }

    /// The cost of an operator.
    pub(crate) fn cost(&self, fluents: &Fluents, terms: &[CostTerm], binding: &[u32]) -> Result<f64, NoCost> {
        let Measure::Sum { step, .. } = &self.measure else { return Ok(1.0) };
        let mut sum = *step;
        for term in terms {
            let value = fluents.value(&term.expression, binding).map_err(|_| NoCost::Inapplicable)?;
            let part = term.weight.times(value).ok_or(NoCost::Inapplicable)?;
            sum = sum.plus(part).ok_or(NoCost::Inapplicable)?;
        }
        if sum.sign() < 0 { Err(NoCost::Negative) } else { Ok(sum.to_f64()) }
    }
}

/// The span of the metric's text.
pub(crate) fn metric_span(problem: &Problem) -> Span {
    problem.metric.as_ref().map_or(problem.goal_span, |metric| metric.expression.span)
}

struct WeightedSum {
    weights: FxHashMap<FunctionId, Number>,
    step: Number,
}

impl Default for WeightedSum {
    fn default() -> Self {
        Self { weights: FxHashMap::default(), step: Number::ZERO }
    }
}

impl WeightedSum {
    /// Adds a multiple of the expression; `None` if the result is not a weighted sum.
    fn add(&mut self, e: &Expression, weight: Number) -> Option<()> {
        match &e.kind {
            ExpressionKind::Number(_) => Some(()),
            ExpressionKind::TotalTime => {
                self.step = self.step.plus(weight)?;
                Some(())
            }
            ExpressionKind::Fluent(a) if a.arguments.is_empty() => {
                let known = self.weights.entry(a.function).or_insert(Number::ZERO);
                *known = known.plus(weight)?;
                Some(())
            }
            ExpressionKind::Arithmetic(ArithmeticOperator::Add, parts) => {
                parts.iter().try_for_each(|p| self.add(p, weight))
            }
            ExpressionKind::Arithmetic(ArithmeticOperator::Subtract, parts) => {
                let (first, rest) = parts.split_first()?;
                let negative = weight.negated()?;
                self.add(first, if rest.is_empty() { negative } else { weight })?;
                rest.iter().try_for_each(|p| self.add(p, negative))
            }
            ExpressionKind::Arithmetic(ArithmeticOperator::Multiply, parts) => match parts.as_slice() {
                [Expression { kind: ExpressionKind::Number(n), .. }, other]
                | [other, Expression { kind: ExpressionKind::Number(n), .. }] => {
                    self.add(other, weight.times(Number::from_f64(*n)?)?)
                }
                _ => None,
            },
            _ => None,
        }
    }
}

/// Whether the effect changes weighted fluents only by adding static values without conditions.
fn only_adds(
    effect: &Effect,
    unconditional: bool,
    weights: &FxHashMap<FunctionId, Number>,
    fluents: &Fluents,
) -> bool {
    match &effect.kind {
        EffectKind::And(parts) => parts.iter().all(|p| only_adds(p, unconditional, weights, fluents)),
        EffectKind::Forall(_, inner) | EffectKind::When(_, inner) => {
            only_adds(inner, false, weights, fluents)
        }
        EffectKind::Assign(operator, application, value) => {
            let adds = matches!(operator, AssignOperator::Increase | AssignOperator::Decrease);
            let by_static = matches!(value, AssignedValue::Number(by) if fluents.is_static(by));
            !weights.contains_key(&application.function) || (unconditional && adds && by_static)
        }
        EffectKind::Add(_) | EffectKind::Delete(_) => true,
    }
}
