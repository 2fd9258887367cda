//! Intervals of exact numbers, with open, closed and infinite ends.
//!
//! Invariant: an operation covers every result that members of its operands have. A bound that an exact number cannot
//! hold becomes infinite.

use pddl::model::Comparison;

use crate::number::Number;

/// A finite end of an interval.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct End {
    /// Where it lies.
    pub value: Number,
    /// Whether the interval excludes the value.
    pub open: bool,
}

impl End {
    /// An end that belongs to the interval.
    pub const fn closed(value: Number) -> Self {
        Self { value, open: false }
    }

    /// The lower of two, as the lower end of a hull.
    fn lower(self, other: Self) -> Self {
        match self.value == other.value {
            true => Self { open: self.open && other.open, ..self },
            false if self.value.is_below(other.value) => self,
            false => other,
        }
    }

    /// The upper of two, as the upper end of a hull.
    fn upper(self, other: Self) -> Self {
        match self.value == other.value {
            true => Self { open: self.open && other.open, ..self },
            false if self.value.is_below(other.value) => other,
            false => self,
        }
    }
}

/// All numbers between two ends.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Interval {
    /// The lower end; `None` is -∞.
    pub low: Option<End>,
    /// The upper end; `None` is ∞.
    pub high: Option<End>,
}

impl Interval {
    /// Every number.
    pub const ALL: Self = Self { low: None, high: None };

    /// A single number.
    pub const fn point(value: Number) -> Self {
        let end = Some(End::closed(value));
        Self { low: end, high: end }
    }

    /// The number if there is only one.
    pub fn as_point(self) -> Option<Number> {
        match (self.low, self.high) {
            (Some(low), Some(high)) if low == high && !low.open => Some(low.value),
            _ => None,
        }
    }

    /// Whether no number is in it.
    pub fn is_empty(self) -> bool {
        let (Some(low), Some(high)) = (self.low, self.high) else { return false };
        high.value.is_below(low.value) || (low.value == high.value && (low.open || high.open))
    }

    /// Sums.
    pub fn plus(self, other: Self) -> Self {
        let sum = |a: Option<End>, b: Option<End>| {
            let (a, b) = (a?, b?);
            Some(End { value: a.value.plus(b.value)?, open: a.open || b.open })
        };
        Self { low: sum(self.low, other.low), high: sum(self.high, other.high) }
    }

    /// Products with one number.
    pub fn scaled(self, by: Number) -> Self {
        let end = |end: Option<End>| end.and_then(|e| Some(End { value: e.value.times(by)?, open: e.open }));
        match by.sign() {
            0 => Self::point(Number::ZERO),
            1 => Self { low: end(self.low), high: end(self.high) },
            _ => Self { low: end(self.high), high: end(self.low) },
        }
    }

    /// The numbers with the other sign.
    pub fn negated(self) -> Self {
        self.scaled(Number::integer(-1))
    }

    /// Products.
    pub fn times(self, other: Self) -> Self {
        let (mut low, mut high): (Option<End>, Option<End>) = (None, None);
        let (mut to_minus_infinity, mut to_infinity) = (false, false);
        for (a, sign_a) in [(self.low, -1), (self.high, 1)] {
            for (b, sign_b) in [(other.low, -1), (other.high, 1)] {
                match product((a, sign_a), (b, sign_b)) {
                    Corner::At(end) => {
                        low = Some(low.map_or(end, |own| own.lower(end)));
                        high = Some(high.map_or(end, |own| own.upper(end)));
                    }
                    Corner::MinusInfinity => to_minus_infinity = true,
                    Corner::Infinity => to_infinity = true,
                    Corner::TooLong => return Self::ALL,
                }
            }
        }
        Self { low: low.filter(|_| !to_minus_infinity), high: high.filter(|_| !to_infinity) }
    }

    /// Quotients; every number where the divisor may be zero.
    pub fn over(self, other: Self) -> Self {
        if !other.intersection(Self::point(Number::ZERO)).is_empty() {
            return Self::ALL;
        }
        let inverse = |end: Option<End>| match end {
            // The reciprocal of an infinite end is 0, which is never reached.
            None => Some(End { value: Number::ZERO, open: true }),
            Some(End { value, open }) => value.inverse().map(|value| End { value, open }),
        };
        self.times(Self { low: inverse(other.high), high: inverse(other.low) })
    }

    /// The smallest interval around both.
    pub fn hull(self, other: Self) -> Self {
        let both = |a: Option<End>, b: Option<End>| Some((a?, b?));
        Self {
            low: both(self.low, other.low).map(|(a, b)| a.lower(b)),
            high: both(self.high, other.high).map(|(a, b)| a.upper(b)),
        }
    }

    /// The numbers in both.
    pub fn intersection(self, other: Self) -> Self {
        let pick = |a: Option<End>, b: Option<End>, highest: bool| match (a, b) {
            (Some(a), Some(b)) if a.value == b.value => Some(End { open: a.open || b.open, ..a }),
            (Some(a), Some(b)) => Some(if b.value.is_below(a.value) == highest { a } else { b }),
            (one, None) | (None, one) => one,
        };
        Self { low: pick(self.low, other.low, true), high: pick(self.high, other.high, false) }
    }

    /// The interval without the ends that moved since `before`.
    pub fn widened(self, before: Self) -> Self {
        let kept = |now: Option<End>, then: Option<End>| now.filter(|_| now == then);
        Self { low: kept(self.low, before.low), high: kept(self.high, before.high) }
    }

    /// Whether some number of this one compares so with some number of the other.
    pub fn may(self, comparison: Comparison, other: Self) -> bool {
        let below = |low: Option<End>, high: Option<End>, or_equal: bool| match (low, high) {
            (Some(low), Some(high)) if low.value == high.value => or_equal && !low.open && !high.open,
            (Some(low), Some(high)) => low.value.is_below(high.value),
            _ => true,
        };
        match comparison {
            Comparison::Less => below(self.low, other.high, false),
            Comparison::LessEqual => below(self.low, other.high, true),
            Comparison::Equal => !self.intersection(other).is_empty(),
            Comparison::GreaterEqual => below(other.low, self.high, true),
            Comparison::Greater => below(other.low, self.high, false),
        }
    }

    /// Whether some number of this one does not compare so with some number of the other.
    pub fn may_not(self, comparison: Comparison, other: Self) -> bool {
        match comparison {
            Comparison::Less => self.may(Comparison::GreaterEqual, other),
            Comparison::LessEqual => self.may(Comparison::Greater, other),
            Comparison::Equal => !(self.as_point().is_some() && self == other),
            Comparison::GreaterEqual => self.may(Comparison::Less, other),
            Comparison::Greater => self.may(Comparison::LessEqual, other),
        }
    }
}

/// The product of two ends.
enum Corner {
    At(End),
    MinusInfinity,
    Infinity,
    /// No exact number holds it.
    TooLong,
}

/// Multiplies two ends; an end that is `None` is the infinity of the sign beside it. An infinite end is never reached,
/// so that zero times it is zero.
fn product((a, sign_a): (Option<End>, i32), (b, sign_b): (Option<End>, i32)) -> Corner {
    let is_zero = |end: &End| end.value.is_zero();
    if a.as_ref().is_some_and(is_zero) || b.as_ref().is_some_and(is_zero) {
        // A zero that is reached makes the product reach it.
        let reached = [a, b].into_iter().flatten().any(|end| end.value.is_zero() && !end.open);
        return Corner::At(End { value: Number::ZERO, open: !reached });
    }
    let sign = a.map_or(sign_a, |a| a.value.sign()) * b.map_or(sign_b, |b| b.value.sign());
    match (a, b) {
        (Some(a), Some(b)) => match a.value.times(b.value) {
            Some(value) => Corner::At(End { value, open: a.open || b.open }),
            None => Corner::TooLong,
        },
        _ if sign > 0 => Corner::Infinity,
        _ => Corner::MinusInfinity,
    }
}

impl std::fmt::Display for Interval {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let low = |End { value, open }: End| format!("{} {value}", if open { "above" } else { "at least" });
        let high = |End { value, open }: End| format!("{} {value}", if open { "below" } else { "at most" });
        match (self.low, self.high) {
            (None, None) => write!(f, "anything"),
            (None, Some(end)) => f.write_str(&high(end)),
            (Some(end), None) => f.write_str(&low(end)),
            (Some(a), Some(b)) if a == b => write!(f, "always {}", a.value),
            (Some(a), Some(b)) if !a.open && !b.open => write!(f, "between {} and {}", a.value, b.value),
            (Some(a), Some(b)) => write!(f, "{} and {}", low(a), high(b)),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn between(low: i64, high: i64) -> Interval {
        let end = |value| Some(End::closed(Number::integer(value)));
        Interval { low: end(low), high: end(high) }
    }

    fn contains(interval: Interval, value: Option<Number>) -> bool {
        value.is_some_and(|value| interval.may(Comparison::Equal, Interval::point(value)))
    }

    #[test]
    fn arithmetic_covers_every_value() {
        let (a, b) = (between(-2, 3), between(1, 4));
        for (x, y) in [(-2.0, 1.0), (3.0, 4.0), (0.5, 2.0), (-2.0, 4.0)] {
            let [x, y] = [x, y].map(|value| Number::from_f64(value).expect("it is short"));
            assert!(contains(a.plus(b), x.plus(y)));
            assert!(contains(a.times(b), x.times(y)));
            assert!(contains(a.over(b), y.inverse().and_then(|y| x.times(y))));
            assert!(contains(a.plus(b.negated()), y.negated().and_then(|y| x.plus(y))));
        }
        assert_eq!(a.times(b), between(-8, 12));
        assert_eq!(b.over(a), Interval::ALL);
        assert_eq!(Interval::point(Number::ZERO).times(Interval::ALL), Interval::point(Number::ZERO));
    }

    #[test]
    fn products_with_infinite_and_open_ends_cover_every_value() {
        let at_least = |value| Interval { high: None, ..between(value, value) };
        assert_eq!(at_least(2).times(at_least(3)), at_least(6));
        assert_eq!(at_least(-1).times(at_least(3)), Interval::ALL);
        assert_eq!(at_least(0).times(between(0, 5)).low, Some(End::closed(Number::ZERO)));
        let open = Interval { low: Some(End { value: Number::ZERO, open: true }), high: None };
        assert!(!contains(open.times(open), Some(Number::ZERO)));
        assert!(!contains(between(1, 2).over(open), Some(Number::ZERO)));
    }

    #[test]
    fn comparisons_respect_open_ends() {
        let low = between(0, 1);
        let one = Interval::point(Number::ONE);
        assert!(!low.may(Comparison::Greater, one));
        assert!(low.may(Comparison::GreaterEqual, one));
        assert!(low.may_not(Comparison::Equal, one));
        assert!(!one.may_not(Comparison::Equal, one));
        let below = Interval { high: Some(End { value: Number::ONE, open: true }), ..low };
        assert!(!below.may(Comparison::GreaterEqual, one));
        assert!(!below.may(Comparison::Equal, one));
        assert_eq!(
            (low.to_string(), below.to_string()),
            ("between 0 and 1".into(), "at least 0 and below 1".into())
        );
    }
}
