//! An expression as a function of time, while fluents change continuously.

use crate::curve::Curve;
use crate::number::{NoResult, Number};
use crate::root::{Instant, Polynomial, Undecided};
use crate::scene::{Binding, Scene};
use crate::state::{Curves, Passage};
use crate::verdict::{ChangeFault, NumericFault};
use pddl::Span;
use pddl::model::{ArithmeticOperator, Expression, ExpressionKind, GroundApplication};
use std::cmp::Ordering;

/// The order of two sides of a comparison at an instant of continuous change.
pub(crate) fn order(
    passage: &Passage,
    scene: Scene<'_>,
    left: &Expression,
    right: &Expression,
    binding: &Binding,
) -> Result<Ordering, Undecided> {
    let difference = difference(&passage.curves, left, right, scene, binding)?;
    let polynomial = difference.map_or_else(|| Polynomial::new([]), |curve| curve.polynomial());
    match &passage.at {
        Instant::At(number) => Ok(polynomial.sign(&number.to_rational())),
        Instant::Root(root) => root.sign_of(&polynomial),
    }
}

/// The difference of two sides; `None` if one of them is undefined.
pub(crate) fn difference(
    curves: &Curves,
    left: &Expression,
    right: &Expression,
    scene: Scene<'_>,
    binding: &Binding,
) -> Result<Option<Curve>, Undecided> {
    let side =
        |expression| curve_of(expression, scene, binding, &mut |fluent| Ok(curves.get(fluent).cloned()));
    match (side(left), side(right)) {
        (Ok(left), Ok(right)) => left.minus(&right).map(Some).map_err(|_| Undecided),
        (
            Err(
                ChangeFault::Numeric(NumericFault::Overflow { .. })
                | ChangeFault::NotPolynomialExpression { .. },
            ),
            _,
        )
        | (
            _,
            Err(
                ChangeFault::Numeric(NumericFault::Overflow { .. })
                | ChangeFault::NotPolynomialExpression { .. },
            ),
        ) => Err(Undecided),
        _ => Ok(None),
    }
}

/// Looks up the curve of a fluent; `None` if the fluent does not change.
type Lookup<'f> = dyn FnMut(&GroundApplication) -> Result<Option<Curve>, ChangeFault> + 'f;

/// The curve of an expression.
pub(crate) fn curve_of(
    expression: &Expression,
    scene: Scene<'_>,
    binding: &Binding,
    running: &mut Lookup<'_>,
) -> Result<Curve, ChangeFault> {
    let span = expression.span;
    match &expression.kind {
        ExpressionKind::Fluent(application) => {
            let fluent = scene.ground(application, binding);
            if let Some(curve) = running(&fluent)? {
                return Ok(curve);
            }
        }
        ExpressionKind::Arithmetic(operator, operands) => {
            let Some((first, rest)) = operands.split_first() else {
                return Ok(Curve::constant(Number::ZERO));
            };
            let mut result = curve_of(first, scene, binding, running)?;
            if rest.is_empty() && *operator == ArithmeticOperator::Subtract {
                return Ok(result.negated());
            }
            for operand in rest {
                let operand = curve_of(operand, scene, binding, running)?;
                result = match operator {
                    ArithmeticOperator::Add => result.plus(&operand),
                    ArithmeticOperator::Subtract => result.minus(&operand),
                    ArithmeticOperator::Multiply => result.times(&operand),
                    ArithmeticOperator::Divide => match operand.as_constant() {
                        Some(divisor) => result.over(divisor),
                        None => return Err(ChangeFault::NotPolynomialExpression { span }),
                    },
                }
                .map_err(|fault| numeric(fault, span))?;
            }
            return Ok(result);
        }
        ExpressionKind::Number(_)
        | ExpressionKind::Duration
        | ExpressionKind::TotalTime
        | ExpressionKind::IsViolated(_) => {}
    }
    scene.number(expression, binding).map(Curve::constant).map_err(ChangeFault::Numeric)
}

pub(crate) fn numeric(fault: NoResult, span: Span) -> ChangeFault {
    ChangeFault::Numeric(NumericFault::of(fault, span))
}
