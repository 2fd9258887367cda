//! Action costs: which fluents the metric adds up, and what an operator adds to them.
//!
//! Idea: a metric that minimises a weighted sum of fluents without arguments, which actions only
//! increase by static values, is a sum of operator costs. Fluents that nothing reads are ignored.
//! Without such a metric every action costs 1. Costs become integers by a common power of ten.

use super::error::{Feature, GroundError, Origin};
use pddl::Span;
use pddl::model::{
    Application, ArithmeticOperator, AssignOperator, AssignedValue, Domain, Effect, EffectKind, Expression,
    ExpressionKind, FluentValue, FunctionId, FunctionValue, Objective, Problem, Term,
};
use rustc_hash::{FxHashMap, FxHashSet};

/// A weighted increase.
#[derive(Clone, Debug)]
pub(crate) struct CostTerm {
    weight: f64,
    expression: Expression,
}

/// What costs are in this task.
pub(crate) struct CostModel<'a> {
    domain: &'a Domain,
    /// Weight of each fluent that the metric reads; `None` without a metric on fluents.
    weights: Option<FxHashMap<FunctionId, f64>>,
    values: FxHashMap<(FunctionId, Vec<u32>), f64>,
    assigned: FxHashSet<FunctionId>,
}

impl<'a> CostModel<'a> {
    pub(crate) fn new(domain: &'a Domain, problem: &Problem) -> Result<Self, GroundError> {
        let mut assigned = FxHashSet::default();
        for action in &domain.actions {
            assigned_functions(&action.effect, &mut assigned);
        }
        let mut values = FxHashMap::default();
        for fluent in &problem.fluents {
            if let FluentValue::Number(n) = fluent.value {
                let row = fluent.application.arguments.iter().map(|o| o.0).collect();
                values.insert((fluent.application.function, row), n);
            }
        }
        let mut model = Self { domain, weights: None, values, assigned };
        if let Some(metric) = &problem.metric {
            let unsupported = GroundError::Unsupported {
                feature: Feature::Metric,
                origin: Origin::Problem,
                span: metric.expression.span,
            };
            let mut weights = FxHashMap::default();
            let sign = if metric.objective == Objective::Minimize { 1.0 } else { -1.0 };
            if !linear(&metric.expression, sign, &mut weights) {
                return Err(unsupported);
            }
            weights.retain(|f, w| *w != 0.0 && model.assigned.contains(f));
            if weights.values().any(|&w| w < 0.0) {
                return Err(unsupported);
            }
            // A metric that no action changes (total-time) leaves the length of the plan to minimise.
            model.weights = (!weights.is_empty()).then_some(weights);
        }
        Ok(model)
    }

    /// What a numeric effect adds to the operator's cost; `None` if nothing reads it.
    pub(crate) fn effect(
        &self,
        operator: AssignOperator,
        application: &Application,
        value: &AssignedValue,
        span: Span,
    ) -> Result<Option<CostTerm>, GroundError> {
        let refuse = |feature| Err(GroundError::Unsupported { feature, origin: Origin::Domain, span });
        let AssignedValue::Number(expression) = value else {
            return refuse(Feature::ObjectFluents);
        };
        if self.domain.functions[application.function].value != FunctionValue::Number {
            return refuse(Feature::ObjectFluents);
        }
        let Some(&weight) = self.weights.as_ref().and_then(|w| w.get(&application.function)) else {
            return Ok(None);
        };
        let sign = match operator {
            AssignOperator::Increase => 1.0,
            AssignOperator::Decrease => -1.0,
            _ => return refuse(Feature::Metric),
        };
        if !self.is_static(expression) {
            return refuse(Feature::NumericFluents);
        }
        Ok(Some(CostTerm { weight: weight * sign, expression: expression.clone() }))
    }

    fn is_static(&self, e: &Expression) -> bool {
        match &e.kind {
            ExpressionKind::Number(_) => true,
            ExpressionKind::Fluent(a) => !self.assigned.contains(&a.function),
            ExpressionKind::Arithmetic(_, parts) => parts.iter().all(|p| self.is_static(p)),
            ExpressionKind::Duration | ExpressionKind::TotalTime | ExpressionKind::IsViolated(_) => false,
        }
    }

    /// Whether each action costs 1.
    pub(crate) fn is_unit(&self) -> bool {
        self.weights.is_none()
    }

    /// The cost of an operator, or the place of what has no value or makes it negative.
    pub(crate) fn cost(&self, terms: &[CostTerm], binding: &[u32]) -> Result<f64, Span> {
        if self.is_unit() {
            return Ok(1.0);
        }
        let mut sum = 0.0;
        for term in terms {
            sum += term.weight * self.value(&term.expression, binding).ok_or(term.expression.span)?;
        }
        match terms.first() {
            Some(first) if !sum.is_finite() || sum < 0.0 => Err(first.expression.span),
            _ => Ok(sum),
        }
    }

    fn value(&self, e: &Expression, binding: &[u32]) -> Option<f64> {
        Some(match &e.kind {
            ExpressionKind::Number(n) => *n,
            ExpressionKind::Fluent(a) => {
                let row = a.arguments.iter().map(|&t| resolve(t, binding)).collect();
                *self.values.get(&(a.function, row))?
            }
            ExpressionKind::Arithmetic(op, parts) => {
                let values = parts.iter().map(|p| self.value(p, binding)).collect::<Option<Vec<_>>>()?;
                let (&first, rest) = values.split_first()?;
                match op {
                    ArithmeticOperator::Subtract if rest.is_empty() => -first,
                    ArithmeticOperator::Add => rest.iter().fold(first, |a, b| a + b),
                    ArithmeticOperator::Subtract => rest.iter().fold(first, |a, b| a - b),
                    ArithmeticOperator::Multiply => rest.iter().fold(first, |a, b| a * b),
                    ArithmeticOperator::Divide => rest.iter().fold(first, |a, b| a / b),
                }
            }
            ExpressionKind::Duration | ExpressionKind::TotalTime | ExpressionKind::IsViolated(_) => {
                return None;
            }
        })
    }
}

pub(crate) fn resolve(term: Term, binding: &[u32]) -> u32 {
    match term {
        Term::Variable(v) => binding[v.0 as usize],
        Term::Object(o) => o.0,
    }
}

/// The smallest power of ten that makes all costs integers (up to six decimals).
pub(crate) fn scale(costs: &[f64]) -> u32 {
    (0..6)
        .map(|k| 10_u32.pow(k))
        .find(|&s| costs.iter().all(|c| ((c * f64::from(s)) - (c * f64::from(s)).round()).abs() < 1e-6))
        .unwrap_or(1_000_000)
}

fn linear(e: &Expression, weight: f64, weights: &mut FxHashMap<FunctionId, f64>) -> bool {
    match &e.kind {
        ExpressionKind::Number(_) | ExpressionKind::TotalTime => true,
        ExpressionKind::Fluent(a) if a.arguments.is_empty() => {
            *weights.entry(a.function).or_insert(0.0) += weight;
            true
        }
        ExpressionKind::Arithmetic(ArithmeticOperator::Add, parts) => {
            parts.iter().all(|p| linear(p, weight, weights))
        }
        ExpressionKind::Arithmetic(ArithmeticOperator::Multiply, parts) => match parts.as_slice() {
            [Expression { kind: ExpressionKind::Number(n), .. }, other]
            | [other, Expression { kind: ExpressionKind::Number(n), .. }] => {
                linear(other, weight * n, weights)
            }
            _ => false,
        },
        _ => false,
    }
}

fn assigned_functions(effect: &Effect, out: &mut FxHashSet<FunctionId>) {
    match &effect.kind {
        EffectKind::And(parts) => parts.iter().for_each(|p| assigned_functions(p, out)),
        EffectKind::Forall(_, inner) | EffectKind::When(_, inner) => assigned_functions(inner, out),
        EffectKind::Assign(_, application, _) => {
            out.insert(application.function);
        }
        EffectKind::Add(_) | EffectKind::Delete(_) => {}
    }
}
