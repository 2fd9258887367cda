//! How a numeric fluent runs between two happenings: a polynomial of the time since the first of them.
//!
//! Problem: a condition that must hold over an open interval cannot be asked at every instant. Idea: with
//! rates that are constant, or that depend on other running fluents without a circle, every fluent is a
//! polynomial, and so is every sum, difference and product of fluents. A comparison can change its
//! truth only at a root of the difference of its sides; between roots one instant speaks for all.
//!
//! Roots are exact where they are rational with a denominator that a double can tell (every linear one,
//! and those of higher degree that a file's decimals usually make); an irrational one is the nearest
//! double. Cost: a curve of degree n has its roots searched between those of its derivative.
//!
//! Source: Howey, Long & Fox, "VAL: Automatic Plan Validation, Continuous Effects and Mixed Initiative
//! Planning using PDDL", ICTAI 2004, §5 (polynomial change and invariants).

use crate::number::{NoResult, Number};

/// Halvings of an interval that ends at neighbouring doubles.
const HALVINGS: usize = 80;

/// Highest power in a curve: rates that multiply each other double it with each.
const MOST_DEGREE: usize = 40;

/// Largest denominator that an exact root is searched with.
const MOST_DENOMINATOR: i64 = 1_000_000;

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

    /// Divided by a number.
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

    fn derivative(&self) -> Result<Self> {
        let powers = (1_i64..).map(Number::integer);
        let rest = self.coefficients.iter().skip(1).zip(powers);
        rest.map(|(&c, power)| c.times(power)).collect::<Result<_>>().map(Self::new)
    }

    /// The value at a time.
    pub(crate) fn at(&self, time: Number) -> Result<Number> {
        self.coefficients.iter().rev().try_fold(Number::ZERO, |value, &c| value.times(time)?.plus(c))
    }

    /// Where the curve is zero inside the open interval `from..to`, in order. A curve that is zero everywhere has no
    /// such place: its comparisons never change.
    pub(crate) fn roots(&self, from: Number, to: Number) -> Result<Vec<Number>> {
        match self.coefficients.as_slice() {
            [] | [_] => Ok(Vec::new()),
            &[constant, slope] => {
                let root = constant.negated().over(slope)?;
                Ok(if from < root && root < to { vec![root] } else { Vec::new() })
            }
            _ => self.roots_between_extremes(from, to),
        }
    }

    fn roots_between_extremes(&self, from: Number, to: Number) -> Result<Vec<Number>> {
        let mut borders = vec![from];
        borders.extend(self.derivative()?.roots(from, to)?);
        borders.push(to);
        let mut roots = Vec::new();
        for pair in borders.windows(2) {
            let (left, right) = (pair[0], pair[1]);
            let (low, high) = (self.at(left)?, self.at(right)?);
            if left > from && low == Number::ZERO {
                roots.push(left);
            } else if low != Number::ZERO
                && high != Number::ZERO
                && (low < Number::ZERO) != (high < Number::ZERO)
            {
                roots.push(self.root_between(left, right, low < Number::ZERO)?);
            }
        }
        roots.dedup();
        Ok(roots)
    }

    /// The root in a stretch where the curve only rises, or only falls.
    fn root_between(&self, left: Number, right: Number, rises: bool) -> Result<Number> {
        let (mut low, mut high) = (left.to_f64(), right.to_f64());
        for _ in 0..HALVINGS {
            let middle = f64::midpoint(low, high);
            if middle <= low || middle >= high {
                break;
            }
            let value = self.coefficients.iter().rev().fold(0.0_f64, |v, c| v.mul_add(middle, c.to_f64()));
            if (value < 0.0) == rises {
                low = middle;
            } else {
                high = middle;
            }
        }
        for end in [low, high, f64::midpoint(low, high)] {
            if let Some(exact) = nearby_ratio(end)
                && left < exact
                && exact < right
                && self.at(exact)? == Number::ZERO
            {
                return Ok(exact);
            }
        }
        Number::from_f64(low).ok_or(NoResult::Overflow)
    }
}

/// The ratio with the smallest denominator that is next to `value` as doubles go, by its continued fraction.
fn nearby_ratio(value: f64) -> Option<Number> {
    let (mut before, mut last) = ((0_i64, 1_i64), (1_i64, 0_i64));
    let mut rest = value;
    loop {
        let whole = rest.floor();
        if whole.abs() > 1e15 {
            return None;
        }
        #[expect(clippy::cast_possible_truncation, reason = "it is below 2^53")]
        let digit = whole as i64;
        let next = (
            digit.checked_mul(last.0)?.checked_add(before.0)?,
            digit.checked_mul(last.1)?.checked_add(before.1)?,
        );
        if next.1 > MOST_DENOMINATOR {
            return None;
        }
        if (next.0 as f64 / next.1 as f64 - value).abs() <= 1e-12 * value.abs().max(1.0) {
            return Number::integer(next.0).over(Number::integer(next.1)).ok();
        }
        (before, last) = (last, next);
        rest = 1.0 / (rest - whole);
    }
}

#[cfg(test)]
mod tests {
    use super::Curve;
    use crate::number::Number;
    use proptest::prelude::*;

    fn number(value: f64) -> Number {
        Number::from_f64(value).unwrap()
    }

    fn curve(coefficients: &[f64]) -> Curve {
        Curve::new(coefficients.iter().map(|&c| number(c)).collect())
    }

    fn roots(coefficients: &[f64], to: f64) -> Vec<String> {
        curve(coefficients).roots(Number::ZERO, number(to)).unwrap().iter().map(ToString::to_string).collect()
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
    fn a_root_that_is_irrational_is_near() {
        let found = curve(&[-2.0, 0.0, 1.0]).roots(Number::ZERO, number(2.0)).unwrap();
        assert!(matches!(found.as_slice(), [root] if (root.to_f64() - 2.0_f64.sqrt()).abs() < 1e-12));
    }

    #[test]
    fn falling_is_the_integral_of_gravity() {
        let speed = Curve::constant(number(-10.0)).integrated(number(20.0)).unwrap();
        let height = speed.integrated(Number::ZERO).unwrap();
        assert_eq!(height.at(number(2.0)).unwrap(), number(20.0));
        assert_eq!(height.at(number(4.0)).unwrap(), Number::ZERO);
        assert_eq!(height.roots(Number::ZERO, number(5.0)).unwrap(), [number(4.0)]);
    }

    proptest! {
        #[test]
        fn a_product_of_linear_factors_has_their_roots(mut at in prop::collection::btree_set(1_i64..200, 1..5)) {
            let mut product = curve(&[1.0]);
            for &root in &at {
                product = product.times(&Curve::new(vec![Number::integer(-root), Number::integer(1)])).unwrap();
            }
            let found = product.roots(Number::ZERO, Number::integer(100)).unwrap();
            at.retain(|&root| root < 100);
            let expected: Vec<Number> = at.into_iter().map(Number::integer).collect();
            prop_assert_eq!(found, expected);
        }
    }
}
