//! The value of a numeric expression.
//!
//! An expression has no value if it reads an undefined fluent, divides by zero, or has no finite
//! result.
//!
//! Source: Fox & Long, "PDDL2.1", JAIR 2003, §6 (undefined values).

use crate::number::Number;
use crate::scene::{Binding, Scene};
use crate::value::Value;
use crate::verdict::NumericFault;
use pddl::Span;
use pddl::model::{
    Application, ArithmeticOperator, Expression, ExpressionKind, FunctionTerm, GroundApplication,
};

impl Scene<'_> {
    pub(crate) fn ground(&self, application: &Application, binding: &Binding) -> GroundApplication {
        GroundApplication {
            function: application.function,
            arguments: application.arguments.iter().map(|&t| binding.object(t)).collect(),
        }
    }

    pub(crate) fn fluent(&self, application: &Application, binding: &Binding) -> Option<Value> {
        binding.with_objects(&application.arguments, |arguments| {
            self.state.fluent_of(application.function, arguments)
        })
    }

    pub(crate) fn number(&self, expression: &Expression, binding: &Binding) -> Result<Number, NumericFault> {
        let span = expression.span;
        match &expression.kind {
            ExpressionKind::Number(value) => Number::from_f64(*value).ok_or(NumericFault::Overflow { span }),
            ExpressionKind::Fluent(application) => match self.fluent(application, binding) {
                Some(Value::Number(number)) => Ok(number),
                _ => Err(NumericFault::Undefined { fluent: self.ground(application, binding), span }),
            },
            ExpressionKind::Arithmetic(operator, operands) => {
                self.arithmetic(*operator, operands, span, binding)
            }
            ExpressionKind::Duration => self.clock.duration.ok_or(NumericFault::Duration { span }),
            ExpressionKind::TotalTime => Ok(self.clock.now),
            ExpressionKind::IsViolated(name) => {
                Ok(self.clock.violations.map_or(Number::ZERO, |violations| violations.count(name)))
            }
        }
    }

    fn arithmetic(
        &self,
        operator: ArithmeticOperator,
        operands: &[Expression],
        span: Span,
        binding: &Binding,
    ) -> Result<Number, NumericFault> {
        let Some((first, rest)) = operands.split_first() else {
            return Ok(Number::ZERO);
        };
        let mut result = self.number(first, binding)?;
        if rest.is_empty() && operator == ArithmeticOperator::Subtract {
            return Ok(result.negated());
        }
        for operand in rest {
            let operand = self.number(operand, binding)?;
            result = match operator {
                ArithmeticOperator::Add => result.plus(operand),
                ArithmeticOperator::Subtract => result.minus(operand),
                ArithmeticOperator::Multiply => result.times(operand),
                ArithmeticOperator::Divide => result.over(operand),
            }
            .map_err(|fault| NumericFault::of(fault, span))?;
        }
        Ok(result)
    }
}

/// Evaluates functions that are used as arguments and binds their slots to the results.
pub(crate) fn bind_functions(
    scene: Scene<'_>,
    functions: &[FunctionTerm],
    binding: &mut Binding,
) -> Result<(), NumericFault> {
    for term in functions {
        let Some(Value::Object(object)) = scene.fluent(&term.application, binding) else {
            let fluent = scene.ground(&term.application, binding);
            return Err(NumericFault::Undefined { fluent, span: term.application.span });
        };
        binding.set(term.slot, Some(object));
    }
    Ok(())
}
