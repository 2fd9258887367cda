//! Fractions, as little of them as the random tasks need.

use std::cmp::Ordering;

/// In lowest terms, with a positive denominator.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Fraction(i128, i128);

impl Fraction {
    pub const ZERO: Self = Self(0, 1);

    pub fn new(numerator: i128, denominator: i128) -> Self {
        let (mut a, mut b) = (numerator.unsigned_abs(), denominator.unsigned_abs());
        while b != 0 {
            (a, b) = (b, a % b);
        }
        let divisor = i128::try_from(a).unwrap() * denominator.signum();
        Self(numerator / divisor, denominator / divisor)
    }

    pub fn whole(value: usize) -> Self {
        Self(i128::try_from(value).unwrap(), 1)
    }

    pub fn of(literal: f64) -> Self {
        let text = literal.to_string();
        let (whole, rest) = text.split_once('.').unwrap_or((&text, ""));
        let digits: i128 = format!("{whole}{rest}").parse().unwrap();
        Self::new(digits, 10_i128.pow(u32::try_from(rest.len()).unwrap()))
    }

    pub fn plus(self, other: Self) -> Self {
        Self::new(self.0 * other.1 + other.0 * self.1, self.1 * other.1)
    }

    pub fn times(self, other: Self) -> Self {
        Self::new(self.0 * other.0, self.1 * other.1)
    }

    pub fn negated(self) -> Self {
        Self(-self.0, self.1)
    }

    pub fn minus(self, other: Self) -> Self {
        self.plus(other.negated())
    }

    /// One divided by it; nothing has none.
    pub fn inverse(self) -> Option<Self> {
        (self.0 != 0).then(|| Self::new(self.1, self.0))
    }

    /// As close as a double comes, to compare a metric.
    pub fn to_f64(self) -> f64 {
        self.0 as f64 / self.1 as f64
    }
}

impl PartialOrd for Fraction {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl Ord for Fraction {
    fn cmp(&self, other: &Self) -> Ordering {
        (self.0 * other.1).cmp(&(other.0 * self.1))
    }
}
