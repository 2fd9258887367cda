//! Closed intervals of real numbers, with infinite ends.

use pddl::model::Comparison;

/// All numbers from `low` to `high`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Interval {
    /// The least, perhaps -∞.
    pub(crate) low: f64,
    /// The greatest, perhaps ∞.
    pub(crate) high: f64,
}

impl Interval {
    /// Every number.
    pub(crate) const ALL: Self = Self { low: f64::NEG_INFINITY, high: f64::INFINITY };

    /// One number.
    pub(crate) fn point(value: f64) -> Self {
        Self { low: value, high: value }
    }

    /// The interval between two bounds; everything if one of them is no number.
    fn new(low: f64, high: f64) -> Self {
        if low.is_nan() || high.is_nan() { Self::ALL } else { Self { low, high } }
    }

    /// The smallest interval that holds both.
    pub(crate) fn hull(self, other: Self) -> Self {
        Self::new(self.low.min(other.low), self.high.max(other.high))
    }

    /// Whether the number is in it.
    pub(crate) fn contains(self, value: f64) -> bool {
        self.low <= value && value <= self.high
    }

    /// Whether it is a single number.
    pub(crate) fn is_point(self) -> bool {
        self.low == self.high
    }

    /// Sums.
    pub(crate) fn add(self, other: Self) -> Self {
        Self::new(self.low + other.low, self.high + other.high)
    }

    /// The numbers with the other sign.
    pub(crate) fn negate(self) -> Self {
        Self::new(-self.high, -self.low)
    }

    /// Products.
    pub(crate) fn multiply(self, other: Self) -> Self {
        // 0 · ∞ is 0 here: the bound is never attained, the zero is.
        let times = |a: f64, b: f64| if a == 0.0 || b == 0.0 { 0.0 } else { a * b };
        let products = [
            times(self.low, other.low),
            times(self.low, other.high),
            times(self.high, other.low),
            times(self.high, other.high),
        ];
        let low = products.iter().copied().fold(f64::INFINITY, f64::min);
        let high = products.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        Self::new(low, high)
    }

    /// Quotients; anything where the divisor may be zero.
    pub(crate) fn divide(self, other: Self) -> Self {
        if other.contains(0.0) {
            return Self::ALL;
        }
        self.multiply(Self::new(1.0 / other.high, 1.0 / other.low))
    }

    /// Whether some number of the one compares so with some number of the other.
    pub(crate) fn may(self, comparison: Comparison, other: Self) -> bool {
        match comparison {
            Comparison::Less => self.low < other.high,
            Comparison::LessEqual => self.low <= other.high,
            Comparison::Equal => self.low <= other.high && other.low <= self.high,
            Comparison::GreaterEqual => self.high >= other.low,
            Comparison::Greater => self.high > other.low,
        }
    }

    /// Whether some number of the one does not compare so with some number of the other.
    pub(crate) fn may_not(self, comparison: Comparison, other: Self) -> bool {
        match comparison {
            Comparison::Less => self.may(Comparison::GreaterEqual, other),
            Comparison::LessEqual => self.may(Comparison::Greater, other),
            Comparison::Equal => !(self.is_point() && self == other),
            Comparison::GreaterEqual => self.may(Comparison::Less, other),
            Comparison::Greater => self.may(Comparison::LessEqual, other),
        }
    }
}

impl std::fmt::Display for Interval {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match (self.low == f64::NEG_INFINITY, self.high == f64::INFINITY) {
            (true, true) => write!(f, "anything"),
            (true, false) => write!(f, "at most {}", self.high),
            (false, true) => write!(f, "at least {}", self.low),
            (false, false) if self.is_point() => write!(f, "always {}", self.low),
            (false, false) => write!(f, "between {} and {}", self.low, self.high),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn arithmetic_covers_every_value() {
        let a = Interval { low: -2.0, high: 3.0 };
        let b = Interval { low: 1.0, high: 4.0 };
        for (x, y) in [(-2.0, 1.0), (3.0, 4.0), (0.5, 2.0), (-2.0, 4.0)] {
            assert!(a.add(b).contains(x + y));
            assert!(a.multiply(b).contains(x * y));
            assert!(a.divide(b).contains(x / y));
            assert!(a.add(b.negate()).contains(x - y));
        }
        assert_eq!(b.divide(a), Interval::ALL);
        assert_eq!(Interval::point(0.0).multiply(Interval::ALL), Interval::point(0.0));
    }

    #[test]
    fn comparisons_are_open_where_they_should() {
        let low = Interval { low: 0.0, high: 1.0 };
        assert!(!low.may(Comparison::Greater, Interval::point(1.0)));
        assert!(low.may(Comparison::GreaterEqual, Interval::point(1.0)));
        assert!(low.may_not(Comparison::Equal, Interval::point(1.0)));
        assert!(!Interval::point(1.0).may_not(Comparison::Equal, Interval::point(1.0)));
    }
}
