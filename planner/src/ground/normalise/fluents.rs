//! Numeric fluents before grounding: initial values, and which functions are changed and read.
//!
//! Idea: a function that no action changes is a table of constants, and expressions are folded over
//! it. Of the other functions, only those that are read get a place in the state. A fluent without
//! an initial value has no entry; `total-cost` starts at 0 even if `:init` does not define it.

use crate::ground::binding::resolve;
use crate::ground::error::{Feature, GroundError, Origin};
use crate::number::{Expression, NoValue, Number};
use pddl::Span;
use pddl::model::{
    ArithmeticOperator, AssignOperator, AssignedValue, Condition, ConditionKind, Domain, Effect, EffectKind,
    Expression as Written, ExpressionKind, FluentValue, FunctionId, Problem,
};
use rustc_hash::{FxHashMap, FxHashSet};

/// A numeric fluent: its function and its arguments.
pub(crate) type Key = (FunctionId, Box<[u32]>);

/// Stands for `total-time`, the number of steps of a plan.
pub(crate) const STEPS: FunctionId = FunctionId(u32::MAX);

/// The numeric fluents of the model.
pub(crate) struct Fluents {
    values: FxHashMap<Key, Number>,
    /// Functions that some action changes.
    changed: FxHashSet<FunctionId>,
    /// Functions that some action assigns, so that an undefined fluent may get a value.
    assigned: FxHashSet<FunctionId>,
    /// Functions that some action multiplies, which conflicts with an addition.
    scaled: FxHashSet<FunctionId>,
    /// Functions that some action makes undefined.
    undefined: FxHashSet<FunctionId>,
    /// Functions that outside events change: to any value, or to none.
    sensed: FxHashSet<FunctionId>,
    /// Functions that some condition, effect or metric reads.
    read: FxHashSet<FunctionId>,
}

impl Fluents {
    pub(crate) fn new(
        domain: &Domain,
        problem: &Problem,
        sensed: &[FunctionId],
    ) -> Result<Self, GroundError> {
        let mut fluents = Self {
            values: FxHashMap::default(),
            sensed: sensed.iter().copied().collect(),
            changed: FxHashSet::default(),
            assigned: FxHashSet::default(),
            scaled: FxHashSet::default(),
            undefined: FxHashSet::default(),
            read: FxHashSet::default(),
        };
        if let Some(id) = domain.function("total-cost")
            && domain.functions[id].variables.parameters == 0
        {
            fluents.values.insert((id, Box::default()), Number::ZERO);
        }
        for fluent in &problem.fluents {
            if let FluentValue::Number(value) = fluent.value {
                let row = fluent.application.arguments.iter().map(|o| o.0).collect();
                let number = Number::from_f64(value).ok_or(large(Origin::Problem, fluent.span))?;
                fluents.values.insert((fluent.application.function, row), number);
            }
        }
        for action in &domain.actions {
            fluents.condition(&action.precondition, Origin::Domain)?;
            fluents.effect(&action.effect)?;
        }
        for axiom in &domain.axioms {
            fluents.condition(&axiom.body, Origin::Domain)?;
        }
        fluents.condition(&problem.goal, Origin::Problem)?;
        Ok(fluents)
    }

    fn condition(&mut self, condition: &Condition, origin: Origin) -> Result<(), GroundError> {
        if let ConditionKind::Compare(_, left, right) = &condition.kind {
            self.reads(left, origin)?;
            self.reads(right, origin)?;
        }
        condition.parts().try_for_each(|part| self.condition(part, origin))
    }

    fn effect(&mut self, effect: &Effect) -> Result<(), GroundError> {
        match &effect.kind {
            EffectKind::When(when, _) => self.condition(when, Origin::Domain)?,
            EffectKind::Assign(operator, application, value) => {
                self.changed.insert(application.function);
                match operator {
                    AssignOperator::Assign => _ = self.assigned.insert(application.function),
                    AssignOperator::ScaleUp | AssignOperator::ScaleDown => {
                        self.scaled.insert(application.function);
                    }
                    AssignOperator::Increase | AssignOperator::Decrease => {}
                }
                match value {
                    AssignedValue::Number(expression) => self.reads(expression, Origin::Domain)?,
                    AssignedValue::Undefined => {
                        self.undefined.insert(application.function);
                    }
                    AssignedValue::Object(_) => {}
                }
            }
            EffectKind::And(_) | EffectKind::Forall(..) | EffectKind::Add(_) | EffectKind::Delete(_) => {}
        }
        effect.parts().iter().try_for_each(|part| self.effect(part))
    }

    /// Marks the functions that an expression reads.
    pub(crate) fn reads(&mut self, expression: &Written, origin: Origin) -> Result<(), GroundError> {
        let mut large_at = None;
        expression.each(&mut |part| match &part.kind {
            ExpressionKind::Fluent(application) => {
                self.read.insert(application.function);
            }
            ExpressionKind::Number(value) if Number::from_f64(*value).is_none() => large_at = Some(part.span),
            _ => {}
        });
        large_at.map_or(Ok(()), |span| Err(large(origin, span)))
    }

    pub(crate) fn initial(&self, key: &Key) -> Option<Number> {
        self.values.get(key).copied()
    }

    pub(crate) fn changes(&self, function: FunctionId) -> bool {
        self.changed.contains(&function) || self.is_sensed(function)
    }

    /// Whether outside events change it.
    pub(crate) fn is_sensed(&self, function: FunctionId) -> bool {
        self.sensed.contains(&function)
    }

    /// Whether a fluent may have no value in some state.
    pub(crate) fn may_be_undefined(&self, key: &Key) -> bool {
        self.undefined.contains(&key.0) || self.is_sensed(key.0) || !self.values.contains_key(key)
    }

    /// Whether a fluent has a value in some state.
    pub(crate) fn may_be_defined(&self, key: &Key) -> bool {
        self.assigned.contains(&key.0) || self.is_sensed(key.0) || self.values.contains_key(key)
    }

    /// Whether states may have to hold the fluents of this function. If not, actions only add to them, and an action
    /// needs only that they have a value, which the initial state decides.
    pub(crate) fn is_tracked(&self, function: FunctionId) -> bool {
        let among = |set: &FxHashSet<FunctionId>| set.contains(&function);
        [&self.read, &self.assigned, &self.scaled, &self.undefined, &self.sensed].into_iter().any(among)
    }

    /// Whether its value is the same in all states.
    pub(crate) fn is_static(&self, expression: &Written) -> bool {
        let mut fixed = true;
        expression.each(&mut |part| {
            fixed &= match &part.kind {
                ExpressionKind::Fluent(application) => !self.changes(application.function),
                ExpressionKind::Number(_) | ExpressionKind::Arithmetic(..) => true,
                ExpressionKind::Duration | ExpressionKind::TotalTime | ExpressionKind::IsViolated(_) => false,
            };
        });
        fixed
    }

    /// Folds constants in an expression under a binding.
    pub(crate) fn fold(&self, expression: &Written, binding: &[u32]) -> Result<Expression<Key>, NoValue> {
        match &expression.kind {
            ExpressionKind::Number(value) => {
                Number::from_f64(*value).map(Expression::constant).ok_or(NoValue::Overflow)
            }
            ExpressionKind::Fluent(application) => {
                let row = application.arguments.iter().map(|&t| resolve(t, binding)).collect();
                let key = (application.function, row);
                match self.initial(&key) {
                    Some(value) if !self.changes(key.0) => Ok(Expression::constant(value)),
                    _ if self.may_be_defined(&key) => Ok(Expression::fluent(key)),
                    _ => Err(NoValue::Undefined),
                }
            }
            ExpressionKind::Arithmetic(operator, parts) => {
                let mut parts = parts.iter().map(|part| self.fold(part, binding));
                let first = parts.next().unwrap_or(Ok(Expression::constant(Number::ZERO)))?;
                if *operator == ArithmeticOperator::Subtract && parts.len() == 0 {
                    return first.negated();
                }
                parts.try_fold(first, |sum, part| match operator {
                    ArithmeticOperator::Add => sum.plus(part?),
                    ArithmeticOperator::Subtract => sum.minus(part?),
                    ArithmeticOperator::Multiply => sum.times(part?),
                    ArithmeticOperator::Divide => sum.over(part?),
                })
            }
            // Occurs only in a metric: the number of steps.
            ExpressionKind::TotalTime => Ok(Expression::fluent((STEPS, Box::default()))),
            ExpressionKind::Duration | ExpressionKind::IsViolated(_) => Err(NoValue::Undefined),
        }
    }

    /// The difference of two expressions under a binding, with constants folded.
    pub(crate) fn difference(
        &self,
        left: &Written,
        right: &Written,
        binding: &[u32],
    ) -> Result<Expression<Key>, NoValue> {
        self.fold(left, binding)?.minus(self.fold(right, binding)?)
    }

    /// The value of a static expression.
    pub(crate) fn value(&self, expression: &Written, binding: &[u32]) -> Result<Number, NoValue> {
        self.fold(expression, binding)?.as_constant().ok_or(NoValue::Undefined)
    }
}

fn large(origin: Origin, span: Span) -> GroundError {
    GroundError::Unsupported { feature: Feature::LargeNumbers, origin, span }
}
