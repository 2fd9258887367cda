//! A numeric fluent between two happenings: a polynomial of the time since the first of them.
//!
//! Problem: a condition that must hold over an open interval cannot be evaluated at every instant. Idea: if rates are
//! constant, or depend on other changing fluents without a cycle, every fluent is a polynomial, and so is every sum,
//! difference and product of fluents. A comparison changes its truth only at a root of the difference of its sides;
//! between two roots, one instant represents all.
//!
//! Roots are exact: a fraction, or an isolated root ([`Instant`]). Cost: a division for a line, Sturm's sequence for
//! a higher degree.
//!
//! Source: Howey, Long & Fox, "VAL: Automatic Plan Validation, Continuous Effects and Mixed Initiative Planning using
//! PDDL", ICTAI 2004, §5 (polynomial change and invariants).

use crate::number::{NoResult, Number};
use crate::root::{Instant, Polynomial, Undecided};

/// The highest power of a curve; multiplying rates doubles the power each time.
const MOST_DEGREE: usize = 40;

/// A polynomial; `coefficients[n]` belongs to the n-th power. The highest is not zero.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Curve {
    coefficients: Vec<Number>,
}

type Result<T> = std::result::Result<T, NoResult>;

impl Curve {
    pub(crate) fn constant(value: Number) -> Self {
        Self::new(vec![value])
    }

    /// A line through a value at time 0, with a slope per second.
    pub(crate) fn line(value: Number, slope: Number) -> Self {
        Self::new(vec![value, slope])
    }

    fn new(mut coefficients: Vec<Number>) -> Self {
        while coefficients.last().is_some_and(|&c| c == Number::ZERO) {
            coefficients.pop();
        }
        Self { coefficients }
    }

    /// The value, if it never changes.
    pub(crate) fn as_constant(&self) -> Option<Number> {
        match self.coefficients.as_slice() {
            [] => Some(Number::ZERO),
            [only] => Some(*only),
            _ => None,
        }
    }

    pub(crate) fn plus(&self, other: &Self) -> Result<Self> {
        let length = self.coefficients.len().max(other.coefficients.len());
        let at = |curve: &Self, n: usize| curve.coefficients.get(n).copied().unwrap_or(Number::ZERO);
        (0..length).map(|n| at(self, n).plus(at(other, n))).collect::<Result<_>>().map(Self::new)
    }

    pub(crate) fn negated(&self) -> Self {
        Self { coefficients: self.coefficients.iter().map(|c| c.negated()).collect() }
    }

    pub(crate) fn minus(&self, other: &Self) -> Result<Self> {
        self.plus(&other.negated())
    }

    pub(crate) fn times(&self, other: &Self) -> Result<Self> {
        if self.coefficients.len() + other.coefficients.len() > MOST_DEGREE {
            return Err(NoResult::Overflow);
        }
        let mut product = vec![Number::ZERO; (self.coefficients.len() + other.coefficients.len()).max(1)];
        for (i, &a) in self.coefficients.iter().enumerate() {
            for (j, &b) in other.coefficients.iter().enumerate() {
                product[i + j] = product[i + j].plus(a.times(b)?)?;
            }
        }
        Ok(Self::new(product))
    }

    /// The curve divided by a number.
    pub(crate) fn over(&self, divisor: Number) -> Result<Self> {
        self.coefficients.iter().map(|c| c.over(divisor)).collect::<Result<_>>().map(Self::new)
    }

    /// The curve that starts at `start` and grows at the rate of `self`.
    pub(crate) fn integrated(&self, start: Number) -> Result<Self> {
        let mut coefficients = vec![start];
        for (power, &c) in (1_i64..).zip(&self.coefficients) {
            coefficients.push(c.over(Number::integer(power))?);
        }
        Ok(Self::new(coefficients))
    }

    /// The value at a time.
    pub(crate) fn at(&self, time: Number) -> Result<Number> {
        self.coefficients.iter().rev().try_fold(Number::ZERO, |value, &c| value.times(time)?.plus(c))
    }

    /// Whether no coefficient was rounded.
    pub(crate) fn is_exact(&self) -> bool {
        self.coefficients.iter().all(|c| c.is_exact())
    }

    pub(crate) fn polynomial(&self) -> Polynomial {
        Polynomial::new(self.coefficients.iter().copied())
    }

    /// The zeros of the curve inside the open interval `from..to`, in order. A curve that is zero
    /// everywhere has none, because its comparisons never change.
    pub(crate) fn roots(&self, from: Number, to: Number) -> std::result::Result<Vec<Instant>, Undecided> {
        match self.coefficients.as_slice() {
            [] | [_] => Ok(Vec::new()),
            &[constant, slope] => match constant.negated().over(slope) {
                Ok(root) if root.is_exact() || !self.is_exact() => {
                    Ok(if from < root && root < to { vec![Instant::At(root)] } else { Vec::new() })
                }
                _ => self.polynomial().roots(from, to),
            },
            _ => self.polynomial().roots(from, to),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::Curve;
    use crate::number::Number;
    use crate::root::Instant;
    use proptest::prelude::*;

    fn number(value: f64) -> Number {
        Number::from_f64(value).unwrap()
    }

    fn curve(coefficients: &[f64]) -> Curve {
        Curve::new(coefficients.iter().map(|&c| number(c)).collect())
    }

    fn roots(coefficients: &[f64], to: f64) -> Vec<String> {
        curve(coefficients)
            .roots(Number::ZERO, number(to))
            .unwrap()
            .iter()
            .map(|root| root.near().to_string())
            .collect()
    }

    #[test]
    fn roots_that_are_rational_are_exact() {
        assert_eq!(roots(&[-1.0, 3.0], 1.0), ["1/3"]);
        assert_eq!(roots(&[2.0, -3.0, 1.0], 5.0), ["1", "2"]);
        assert_eq!(roots(&[1.0, -2.0, 1.0], 5.0), ["1"], "a curve that only touches zero");
        assert_eq!(roots(&[0.0, 1.0], 5.0), [""; 0], "the ends do not belong to the interval");
        assert_eq!(roots(&[-6.0, 11.0, -6.0, 1.0], 10.0), ["1", "2", "3"]);
    }

    #[test]
    fn falling_is_the_integral_of_gravity() {
        let speed = Curve::constant(number(-10.0)).integrated(number(20.0)).unwrap();
        let height = speed.integrated(Number::ZERO).unwrap();
        assert_eq!(height.at(number(2.0)).unwrap(), number(20.0));
        assert_eq!(height.at(number(4.0)).unwrap(), Number::ZERO);
        let landing = height.roots(Number::ZERO, number(5.0)).unwrap();
        assert!(matches!(landing.as_slice(), [Instant::At(time)] if *time == number(4.0)));
    }

    proptest! {
        #[test]
        fn a_product_of_linear_factors_has_their_roots(mut at in prop::collection::btree_set(1_i64..200, 1..5)) {
            let mut product = curve(&[1.0]);
            for &root in &at {
                product = product.times(&Curve::new(vec![Number::integer(-root), Number::integer(1)])).unwrap();
            }
            let found = product.roots(Number::ZERO, Number::integer(100)).unwrap();
            let found: Vec<Number> = found.iter().map(Instant::near).collect();
            at.retain(|&root| root < 100);
            let expected: Vec<Number> = at.into_iter().map(Number::integer).collect();
            prop_assert_eq!(found, expected);
        }
    }
}
