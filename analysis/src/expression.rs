//! Expressions over numeric fluents, linear as long as they can be.
//!
//! Idea: sums and products by constants are kept as coefficients, so that equal conditions written
//! differently are one, and how an effect moves a condition can be read off. Products of fluents and
//! divisions by them stay trees. Invariant: a fluent that cancels out keeps its term with coefficient
//! 0, because without its value the expression has none.

use crate::number::Number;

/// Why an expression has no value.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum NoValue {
    /// A fluent without a value, or a division by zero.
    Undefined,
    /// More digits than we keep.
    Overflow,
}

/// What joins the parts of a tree.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Operator {
    /// A sum.
    Add,
    /// A product.
    Multiply,
    /// A quotient.
    Divide,
}

/// A weighted sum.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct Linear<V> {
    /// Sorted by fluent, each once.
    pub terms: Vec<(V, Number)>,
    /// What is added to them.
    pub constant: Number,
}

/// An expression over fluents `V`.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub enum Expression<V> {
    /// A weighted sum.
    Linear(Linear<V>),
    /// Anything else.
    Tree(Operator, Vec<Expression<V>>),
}

impl<V: Clone + Ord> Expression<V> {
    /// A number.
    pub fn constant(value: Number) -> Self {
        Self::Linear(Linear { terms: Vec::new(), constant: value })
    }

    /// A fluent.
    pub fn fluent(fluent: V) -> Self {
        Self::Linear(Linear { terms: vec![(fluent, Number::ONE)], constant: Number::ZERO })
    }

    /// Its value if no fluent occurs.
    pub fn as_constant(&self) -> Option<Number> {
        match self {
            Self::Linear(linear) if linear.terms.is_empty() => Some(linear.constant),
            _ => None,
        }
    }

    /// Their sum.
    ///
    /// # Errors
    /// [`NoValue`] where a coefficient does not fit.
    pub fn plus(self, other: Self) -> Result<Self, NoValue> {
        let (left, right) = match (self, other) {
            (Self::Linear(left), Self::Linear(right)) => (left, right),
            (left, right) => return Ok(Self::Tree(Operator::Add, vec![left, right])),
        };
        let mut sum = Linear { terms: Vec::with_capacity(left.terms.len() + right.terms.len()), ..left };
        sum.constant = sum.constant.plus(right.constant).ok_or(NoValue::Overflow)?;
        let (mut left, mut right) = (left.terms.into_iter().peekable(), right.terms.into_iter().peekable());
        while let (Some((a, _)), Some((b, _))) = (left.peek(), right.peek()) {
            match a.cmp(b) {
                std::cmp::Ordering::Less => sum.terms.extend(left.next()),
                std::cmp::Ordering::Greater => sum.terms.extend(right.next()),
                std::cmp::Ordering::Equal => {
                    if let (Some((fluent, a)), Some((_, b))) = (left.next(), right.next()) {
                        sum.terms.push((fluent, a.plus(b).ok_or(NoValue::Overflow)?));
                    }
                }
            }
        }
        sum.terms.extend(left);
        sum.terms.extend(right);
        Ok(Self::Linear(sum))
    }

    /// Their product.
    ///
    /// # Errors
    /// [`NoValue`] where a coefficient does not fit.
    pub fn times(self, other: Self) -> Result<Self, NoValue> {
        match (self, other) {
            (a, b) if a.as_constant().is_none() && b.as_constant().is_none() => {
                Ok(Self::Tree(Operator::Multiply, vec![a, b]))
            }
            (a, b) if a.as_constant().is_none() => b.times(a),
            (a, Self::Linear(mut linear)) => {
                let by = a.as_constant().unwrap_or(Number::ZERO);
                linear.constant = linear.constant.times(by).ok_or(NoValue::Overflow)?;
                for (_, coefficient) in &mut linear.terms {
                    *coefficient = coefficient.times(by).ok_or(NoValue::Overflow)?;
                }
                Ok(Self::Linear(linear))
            }
            (a, b) => Ok(Self::Tree(Operator::Multiply, vec![a, b])),
        }
    }

    /// The expression with the other sign.
    ///
    /// # Errors
    /// [`NoValue`] where a coefficient does not fit.
    pub fn negated(self) -> Result<Self, NoValue> {
        self.times(Self::constant(Number::integer(-1)))
    }

    /// Their difference.
    ///
    /// # Errors
    /// [`NoValue`] where a coefficient does not fit.
    pub fn minus(self, other: Self) -> Result<Self, NoValue> {
        self.plus(other.negated()?)
    }

    /// Their quotient.
    ///
    /// # Errors
    /// [`NoValue`] for a division by the number 0, and where a coefficient does not fit.
    pub fn over(self, other: Self) -> Result<Self, NoValue> {
        match other.as_constant() {
            Some(by) if by.is_zero() => Err(NoValue::Undefined),
            Some(by) => self.times(Self::constant(by.inverse().ok_or(NoValue::Overflow)?)),
            None => Ok(Self::Tree(Operator::Divide, vec![self, other])),
        }
    }

    /// The same over other names for the fluents.
    pub fn map<W: Clone + Ord>(&self, f: &mut impl FnMut(&V) -> W) -> Expression<W> {
        match self {
            Self::Linear(linear) => {
                let mut terms: Vec<(W, Number)> = linear.terms.iter().map(|(v, c)| (f(v), *c)).collect();
                terms.sort_by(|a, b| a.0.cmp(&b.0));
                Expression::Linear(Linear { terms, constant: linear.constant })
            }
            Self::Tree(operator, parts) => {
                Expression::Tree(*operator, parts.iter().map(|part| part.map(f)).collect())
            }
        }
    }

    /// Visits every fluent, possibly more than once.
    pub fn each_fluent(&self, f: &mut impl FnMut(&V)) {
        match self {
            Self::Linear(linear) => linear.terms.iter().for_each(|(v, _)| f(v)),
            Self::Tree(_, parts) => parts.iter().for_each(|part| part.each_fluent(f)),
        }
    }

    /// Whether it may have no value although all fluents have one.
    pub fn divides(&self) -> bool {
        match self {
            Self::Linear(_) => false,
            Self::Tree(Operator::Divide, _) => true,
            Self::Tree(_, parts) => parts.iter().any(Self::divides),
        }
    }

    /// Its value where `value` gives the fluents' values.
    ///
    /// # Errors
    /// [`NoValue`] where a fluent has no value, a divisor is 0, or a number does not fit.
    pub fn evaluate(&self, value: &impl Fn(&V) -> Option<Number>) -> Result<Number, NoValue> {
        match self {
            Self::Linear(linear) => linear.terms.iter().try_fold(linear.constant, |sum, (v, coefficient)| {
                let value = value(v).ok_or(NoValue::Undefined)?;
                let part = coefficient.times(value).ok_or(NoValue::Overflow)?;
                sum.plus(part).ok_or(NoValue::Overflow)
            }),
            Self::Tree(operator, parts) => {
                let mut parts = parts.iter().map(|part| part.evaluate(value));
                let first = parts.next().unwrap_or(Ok(Number::ZERO))?;
                parts.try_fold(first, |sum, part| {
                    let part = part?;
                    match operator {
                        Operator::Add => sum.plus(part),
                        Operator::Multiply => sum.times(part),
                        Operator::Divide if part.is_zero() => return Err(NoValue::Undefined),
                        Operator::Divide => part.inverse().and_then(|inverse| sum.times(inverse)),
                    }
                    .ok_or(NoValue::Overflow)
                })
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::{Expression, NoValue};
    use crate::number::Number;

    fn fluent(name: &'static str) -> Expression<&'static str> {
        Expression::fluent(name)
    }

    fn number(value: i64) -> Expression<&'static str> {
        Expression::constant(Number::integer(value))
    }

    #[test]
    fn what_is_equal_looks_equal() -> Result<(), NoValue> {
        let left = fluent("x").plus(fluent("y"))?.minus(number(3))?.times(number(2))?;
        let right = fluent("y").times(number(2))?.plus(fluent("x").times(number(2))?)?.plus(number(-6))?;
        assert_eq!(left, right);
        Ok(())
    }

    #[test]
    fn what_cancels_out_must_still_have_a_value() -> Result<(), NoValue> {
        let nothing = fluent("x").minus(fluent("x"))?;
        assert_eq!(nothing.evaluate(&|_| None), Err(NoValue::Undefined));
        assert_eq!(nothing.evaluate(&|_| Some(Number::integer(7))), Ok(Number::ZERO));
        Ok(())
    }

    #[test]
    fn products_of_fluents_are_trees() -> Result<(), NoValue> {
        let quotient = fluent("x").times(fluent("y"))?.over(fluent("z"))?;
        let value = |name: &&'static str| match *name {
            "x" => Some(Number::integer(6)),
            "y" => Some(Number::integer(2)),
            _ => Some(Number::integer(4)),
        };
        assert_eq!(quotient.evaluate(&value), Ok(Number::integer(3)));
        let nothing = fluent("x").over(fluent("x").minus(number(6))?)?;
        assert_eq!(nothing.evaluate(&value), Err(NoValue::Undefined));
        assert!(quotient.divides());
        Ok(())
    }
}
