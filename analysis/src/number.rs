//! Exact numbers.
//!
//! Problem: a plan that spends 0.1 ten times has spent 1. A search with rounding errors either misses plans or returns
//! wrong ones, and a bound with rounding errors proves nothing. Idea: rationals over 128-bit integers, whose every
//! operation is checked; a result that does not fit is `None`. Invariant: lowest terms and a positive denominator, so
//! that equal numbers are equal as data. Cost: integers need no greatest common divisor.

/// A rational number.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Number {
    numerator: i128,
    denominator: i128,
}

fn common_divisor(mut a: u128, mut b: u128) -> u128 {
    while b != 0 {
        (a, b) = (b, a % b);
    }
    a
}

impl Number {
    /// Zero.
    pub const ZERO: Self = Self::integer(0);
    /// One.
    pub const ONE: Self = Self::integer(1);

    /// A whole number.
    #[inline]
    pub const fn integer(value: i64) -> Self {
        Self { numerator: value as i128, denominator: 1 }
    }

    /// The value that the shortest decimal form of `value` writes; `None` where that does not fit.
    pub fn from_f64(value: f64) -> Option<Self> {
        if !value.is_finite() {
            return None;
        }
        // Most numbers are written without a fraction, and a grounder meets them a million times.
        #[expect(clippy::cast_possible_truncation, reason = "a whole number below 2^53")]
        if value.fract() == 0.0 && value.abs() < 9e15 {
            return Some(Self { numerator: value as i128, denominator: 1 });
        }
        // The shortest decimal form that reads back as `value`, never with an exponent.
        let text = value.to_string();
        let (whole, fraction) = text.split_once('.').unwrap_or((&text, ""));
        let digits: i128 = format!("{whole}{fraction}").parse().ok()?;
        Self::ratio(digits, 10_i128.checked_pow(u32::try_from(fraction.len()).ok()?)?)
    }

    /// As a double, to about 15 digits.
    #[expect(clippy::cast_precision_loss, reason = "a double is what was asked for")]
    #[inline]
    pub fn to_f64(self) -> f64 {
        self.numerator as f64 / self.denominator as f64
    }

    /// The quotient of two whole numbers; `None` for a zero denominator, or where the result does not fit.
    #[inline]
    pub fn ratio(numerator: i128, denominator: i128) -> Option<Self> {
        if denominator == 0 {
            return None;
        }
        let divisor =
            i128::try_from(common_divisor(numerator.unsigned_abs(), denominator.unsigned_abs())).ok()?;
        let (numerator, denominator) = (numerator / divisor, denominator / divisor);
        Some(if denominator < 0 {
            Self { numerator: numerator.checked_neg()?, denominator: denominator.checked_neg()? }
        } else {
            Self { numerator, denominator }
        })
    }

    /// The numerator in lowest terms.
    #[inline]
    pub fn numerator(self) -> i128 {
        self.numerator
    }

    /// The denominator in lowest terms; positive.
    #[inline]
    pub fn denominator(self) -> i128 {
        self.denominator
    }

    /// Whether it is 0.
    #[inline]
    pub fn is_zero(self) -> bool {
        self.numerator == 0
    }

    /// -1, 0 or 1.
    #[inline]
    pub fn sign(self) -> i32 {
        i32::from(self.numerator > 0) - i32::from(self.numerator < 0)
    }

    /// Whether it is smaller. Where the difference needs more than 128 bits, doubles are compared.
    #[inline]
    pub fn is_below(self, other: Self) -> bool {
        match other.negated().and_then(|negated| self.plus(negated)) {
            Some(difference) => difference.sign() < 0,
            None => self.to_f64() < other.to_f64(),
        }
    }

    /// The sum; `None` where it does not fit.
    #[inline]
    pub fn plus(self, other: Self) -> Option<Self> {
        if self.denominator == other.denominator {
            let numerator = self.numerator.checked_add(other.numerator)?;
            return if self.denominator == 1 {
                Some(Self { numerator, denominator: 1 })
            } else {
                Self::ratio(numerator, self.denominator)
            };
        }
        let left = self.numerator.checked_mul(other.denominator)?;
        let right = other.numerator.checked_mul(self.denominator)?;
        Self::ratio(left.checked_add(right)?, self.denominator.checked_mul(other.denominator)?)
    }

    /// The number with the other sign; `None` where it does not fit.
    #[inline]
    pub fn negated(self) -> Option<Self> {
        Some(Self { numerator: self.numerator.checked_neg()?, denominator: self.denominator })
    }

    /// The product; `None` where it does not fit.
    #[inline]
    pub fn times(self, other: Self) -> Option<Self> {
        let numerator = self.numerator.checked_mul(other.numerator)?;
        let denominator = self.denominator.checked_mul(other.denominator)?;
        if denominator == 1 {
            Some(Self { numerator, denominator })
        } else {
            Self::ratio(numerator, denominator)
        }
    }

    /// The reciprocal; `None` for zero, or where it does not fit.
    #[inline]
    pub fn inverse(self) -> Option<Self> {
        Self::ratio(self.denominator, self.numerator)
    }
}

impl std::fmt::Display for Number {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        // Twos and fives alone: a decimal. Anything else: a double's digits.
        let mut rest = self.denominator;
        let mut places = 0_u32;
        while rest != 1 && places < 18 && (rest % 2 == 0 || rest % 5 == 0) {
            rest /= if rest % 10 == 0 {
                10
            } else if rest % 2 == 0 {
                2
            } else {
                5
            };
            places += 1;
        }
        let scaled = 10_i128.checked_pow(places).and_then(|p| self.numerator.checked_mul(p));
        match scaled {
            _ if self.denominator == 1 => self.numerator.fmt(f),
            Some(scaled) if rest == 1 => {
                let digits = (scaled / self.denominator).unsigned_abs();
                let power = 10_u128.pow(places);
                let sign = if self.numerator < 0 { "-" } else { "" };
                let fraction = format!("{:0width$}", digits % power, width = places as usize);
                write!(f, "{sign}{}.{}", digits / power, fraction.trim_end_matches('0'))
            }
            _ => self.to_f64().fmt(f),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::Number;

    fn read(value: f64) -> Number {
        Number::from_f64(value).expect("it is short")
    }

    #[test]
    fn decimals_are_exact() {
        let tenth = read(0.1);
        let sum = (0..10).try_fold(Number::ZERO, |sum, _| sum.plus(tenth));
        assert_eq!(sum, Some(Number::ONE));
        assert_eq!(read(0.1).plus(read(0.2)), Some(read(0.3)));
        assert_eq!(read(-2.5).times(read(4.0)), Some(Number::integer(-10)));
        assert_eq!(Number::ZERO.inverse(), None);
        assert_eq!(Number::from_f64(f64::NAN), None);
    }

    #[test]
    fn numbers_are_written_as_people_do() {
        for value in [0.0, -0.25, 12.5, 0.005, -3.0, 1e15] {
            assert_eq!(read(value).to_string(), value.to_string());
        }
    }

    #[test]
    fn what_does_not_fit_has_no_value() {
        let large = Number::integer(i64::MAX);
        let square = large.times(large).expect("126 bits");
        assert_eq!(square.times(large), None);
        assert_eq!(Number::from_f64(1e300), None);
    }
}
