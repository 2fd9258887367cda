//! Exact numbers: 0.1 + 0.2 is 0.3.
//!
//! Problem: in floating point, a plan that spends 0.1 ten times has not spent 1. Idea: rationals over 128-bit
//! integers hold every decimal in a file, and every sum, difference, product and quotient that ordinary tasks make.
//! If an exact result needs more than 128 bits, the value becomes the nearest double, and [`Number::is_exact`]
//! reports it. Invariant: exact numbers are in lowest terms with a positive denominator; doubles are finite. Cost:
//! integers never compute a greatest common divisor.

use crate::fraction::simplest;
use num_rational::BigRational;
use num_traits::Zero;
use pddl::Decimal;
use serde::{Serialize, Serializer};
use std::cmp::Ordering;
use std::fmt;

/// A finite number, exact if 128 bits suffice.
#[derive(Clone, Copy)]
pub struct Number(Form);

#[derive(Clone, Copy)]
enum Form {
    Ratio { numerator: i128, denominator: i128 },
    Double(f64),
}

/// An operation has no finite result.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum NoResult {
    DivisionByZero,
    Overflow,
}

fn greatest_common_divisor(mut a: u128, mut b: u128) -> u128 {
    while b != 0 {
        (a, b) = (b, a % b);
    }
    a
}

impl Number {
    /// The number as a decimal of a file, if it has one.
    pub(crate) fn decimal(self) -> Option<Decimal> {
        self.to_string().parse().ok()
    }

    /// Zero.
    pub const ZERO: Self = Self::integer(0);

    /// One billionth.
    pub(crate) const NANO: Self = Self(Form::Ratio { numerator: 1, denominator: 1_000_000_000 });

    /// Larger than any number in a file.
    pub(crate) const MAX: Self = Self(Form::Double(f64::MAX));

    /// An integer.
    pub const fn integer(value: i64) -> Self {
        Self(Form::Ratio { numerator: value as i128, denominator: 1 })
    }

    /// The number whose shortest decimal form is that of `value`; `None` if it is not finite.
    pub fn from_f64(value: f64) -> Option<Self> {
        if !value.is_finite() {
            return None;
        }
        #[expect(clippy::cast_possible_truncation, reason = "a whole number below 2^53 is an i64")]
        if value.fract() == 0.0 && value.abs() < 9e15 {
            return Some(Self::integer(value as i64));
        }
        Some(decimal(&value.to_string()).unwrap_or(Self(Form::Double(value))))
    }

    /// This many thousandths.
    pub const fn thousandths(count: i64) -> Self {
        // In lowest terms: 1000 has the prime divisors 2 and 5 only.
        let (mut numerator, mut denominator) = (count as i128, 1000);
        while denominator % 2 == 0 && numerator % 2 == 0 {
            (numerator, denominator) = (numerator / 2, denominator / 2);
        }
        while denominator % 5 == 0 && numerator % 5 == 0 {
            (numerator, denominator) = (numerator / 5, denominator / 5);
        }
        Self(Form::Ratio { numerator, denominator })
    }

    /// A decimal of a file.
    pub fn from_decimal(value: Decimal) -> Self {
        let (numerator, denominator) = value.fraction();
        Self::ratio(numerator, denominator).unwrap_or(Self(Form::Double(value.to_f64())))
    }

    /// As a double, to about 15 digits.
    pub fn to_f64(self) -> f64 {
        match self.0 {
            Form::Ratio { numerator, denominator } => numerator as f64 / denominator as f64,
            Form::Double(value) => value,
        }
    }

    /// The value as a fraction of unbounded integers; a double has one, too.
    pub(crate) fn to_rational(self) -> BigRational {
        match self.0 {
            Form::Ratio { numerator, denominator } => BigRational::new(numerator.into(), denominator.into()),
            Form::Double(value) => BigRational::from_float(value).expect("a number is finite"),
        }
    }

    /// A fraction, if 128 bits hold it.
    pub(crate) fn of_rational(value: &BigRational) -> Option<Self> {
        Self::ratio(i128::try_from(value.numer()).ok()?, i128::try_from(value.denom()).ok()?)
    }

    /// A double that approximates the true value; it is not exact.
    pub(crate) fn rounded(value: f64) -> Self {
        Self(Form::Double(value.clamp(f64::MIN, f64::MAX)))
    }

    /// The fraction with the smallest denominator between two doubles.
    pub(crate) fn simplest_between(low: f64, high: f64) -> Option<Self> {
        let (low, high) = (BigRational::from_float(low)?, BigRational::from_float(high)?);
        let zero = BigRational::zero();
        if low < zero && zero < high {
            return Some(Self::ZERO);
        }
        if low < zero {
            return Self::of_rational(&-simplest(&-high, &-low));
        }
        Self::of_rational(&simplest(&low, &high))
    }

    /// Whether the number is exact.
    pub fn is_exact(self) -> bool {
        matches!(self.0, Form::Ratio { .. })
    }

    fn ratio(numerator: i128, denominator: i128) -> Option<Self> {
        let divisor = greatest_common_divisor(numerator.unsigned_abs(), denominator.unsigned_abs());
        let divisor = i128::try_from(divisor).ok()?;
        let (numerator, denominator) = (numerator.checked_div(divisor)?, denominator.checked_div(divisor)?);
        Some(Self(if denominator < 0 {
            Form::Ratio { numerator: numerator.checked_neg()?, denominator: denominator.checked_neg()? }
        } else {
            Form::Ratio { numerator, denominator }
        }))
    }

    fn double(value: f64) -> Result<Self, NoResult> {
        if value.is_finite() { Ok(Self(Form::Double(value))) } else { Err(NoResult::Overflow) }
    }

    pub(crate) fn plus(self, other: Self) -> Result<Self, NoResult> {
        if let (Form::Ratio { numerator: a, denominator: b }, Form::Ratio { numerator: c, denominator: d }) =
            (self.0, other.0)
        {
            let exact = if b == 1 && d == 1 {
                a.checked_add(c).map(|numerator| Self(Form::Ratio { numerator, denominator: 1 }))
            } else {
                (|| Self::ratio(a.checked_mul(d)?.checked_add(c.checked_mul(b)?)?, b.checked_mul(d)?))()
            };
            if let Some(exact) = exact {
                return Ok(exact);
            }
        }
        Self::double(self.to_f64() + other.to_f64())
    }

    pub(crate) fn negated(self) -> Self {
        match self.0 {
            Form::Ratio { numerator, denominator } => match numerator.checked_neg() {
                Some(numerator) => Self(Form::Ratio { numerator, denominator }),
                None => Self(Form::Double(-self.to_f64())),
            },
            Form::Double(value) => Self(Form::Double(-value)),
        }
    }

    pub(crate) fn minus(self, other: Self) -> Result<Self, NoResult> {
        self.plus(other.negated())
    }

    pub(crate) fn times(self, other: Self) -> Result<Self, NoResult> {
        if let (Form::Ratio { numerator: a, denominator: b }, Form::Ratio { numerator: c, denominator: d }) =
            (self.0, other.0)
        {
            let exact = if b == 1 && d == 1 {
                a.checked_mul(c).map(|numerator| Self(Form::Ratio { numerator, denominator: 1 }))
            } else {
                (|| Self::ratio(a.checked_mul(c)?, b.checked_mul(d)?))()
            };
            if let Some(exact) = exact {
                return Ok(exact);
            }
        }
        Self::double(self.to_f64() * other.to_f64())
    }

    pub(crate) fn over(self, other: Self) -> Result<Self, NoResult> {
        if other == Self::ZERO {
            return Err(NoResult::DivisionByZero);
        }
        if let (Form::Ratio { numerator: a, denominator: b }, Form::Ratio { numerator: c, denominator: d }) =
            (self.0, other.0)
            && let Some(exact) = (|| Self::ratio(a.checked_mul(d)?, b.checked_mul(c)?))()
        {
            return Ok(exact);
        }
        Self::double(self.to_f64() / other.to_f64())
    }
}

/// Reads `-12.5` exactly, if 128 bits hold it.
fn decimal(text: &str) -> Option<Number> {
    let (negative, digits) = match text.strip_prefix('-') {
        Some(rest) => (true, rest),
        None => (false, text),
    };
    let (whole, fraction) = digits.split_once('.').unwrap_or((digits, ""));
    let mut numerator: i128 = 0;
    for byte in whole.bytes().chain(fraction.bytes()) {
        let digit = byte.checked_sub(b'0').filter(|&d| d < 10)?;
        numerator = numerator.checked_mul(10)?.checked_add(i128::from(digit))?;
    }
    let denominator = 10_i128.checked_pow(u32::try_from(fraction.len()).ok()?)?;
    Number::ratio(if negative { -numerator } else { numerator }, denominator)
}

/// The digits after the decimal point, if there are finitely many.
fn fraction_digits(numerator: i128, denominator: i128) -> Option<String> {
    const MOST: usize = 18;
    let denominator = denominator.unsigned_abs();
    let mut rest = numerator.unsigned_abs() % denominator;
    let mut digits = String::new();
    while rest != 0 {
        rest = rest.checked_mul(10).filter(|_| digits.len() < MOST)?;
        digits.push(char::from(b'0' + u8::try_from(rest / denominator).ok()?));
        rest %= denominator;
    }
    Some(digits)
}

impl PartialEq for Number {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other) == Ordering::Equal
    }
}

impl Eq for Number {}

impl PartialOrd for Number {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl Ord for Number {
    fn cmp(&self, other: &Self) -> Ordering {
        match (self.0, other.0) {
            (Form::Ratio { numerator: a, denominator: b }, Form::Ratio { numerator: c, denominator: d }) => {
                compare_ratios((a, b), (c, d))
            }
            (Form::Double(a), Form::Double(b)) => a.partial_cmp(&b).unwrap_or(Ordering::Equal),
            (Form::Ratio { numerator, denominator }, Form::Double(double)) => {
                compare_with_double((numerator, denominator), double)
            }
            (Form::Double(double), Form::Ratio { numerator, denominator }) => {
                compare_with_double((numerator, denominator), double).reverse()
            }
        }
    }
}

/// Compares exactly; denominators are positive.
fn compare_ratios((mut a, mut b): (i128, i128), (mut c, mut d): (i128, i128)) -> Ordering {
    if b == d {
        return a.cmp(&c);
    }
    if let (Some(left), Some(right)) = (a.checked_mul(d), c.checked_mul(b)) {
        return left.cmp(&right);
    }
    // Compares the continued fractions term by term, which never needs more than 128 bits.
    let mut turned = false;
    loop {
        let order = a.div_euclid(b).cmp(&c.div_euclid(d));
        let (rest, other) = (a.rem_euclid(b), c.rem_euclid(d));
        let order = if order.is_ne() {
            order
        } else if rest == 0 || other == 0 {
            rest.cmp(&other)
        } else {
            (a, b, c, d) = (b, rest, d, other);
            turned = !turned;
            continue;
        };
        return if turned { order.reverse() } else { order };
    }
}

/// Compares a ratio with the exact value of a double. Comparing rounded ratios would make different
/// ratios equal to one double, and the order would be inconsistent.
fn compare_with_double(ratio: (i128, i128), double: f64) -> Ordering {
    const LARGEST: f64 = 170_141_183_460_469_231_731_687_303_715_884_105_728.0; // 2^127
    const BITS: i32 = 126;
    if double >= LARGEST {
        return Ordering::Less;
    }
    if double < -LARGEST {
        return Ordering::Greater;
    }
    let (whole, mut fraction) = (double.floor(), double - double.floor());
    #[expect(clippy::cast_possible_truncation, reason = "it is in the range of an i128")]
    let integer = whole as i128;
    let order = ratio.0.div_euclid(ratio.1).cmp(&integer);
    if order.is_ne() {
        return order;
    }
    // The digits below the last bit are at least zero, so they can only make it larger.
    fraction *= 2.0_f64.powi(BITS);
    #[expect(clippy::cast_possible_truncation, reason = "it is below 2^126")]
    let bits = fraction.floor() as i128;
    let order = compare_ratios((ratio.0.rem_euclid(ratio.1), ratio.1), (bits, 1 << BITS));
    if order.is_eq() && fraction > fraction.floor() { Ordering::Less } else { order }
}

impl fmt::Display for Number {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.0 {
            Form::Ratio { numerator, denominator: 1 } => write!(f, "{numerator}"),
            Form::Ratio { numerator, denominator } => match fraction_digits(numerator, denominator) {
                Some(digits) => {
                    let sign = if numerator < 0 { "-" } else { "" };
                    write!(f, "{sign}{}.{digits}", (numerator / denominator).unsigned_abs())
                }
                None => write!(f, "{numerator}/{denominator}"),
            },
            Form::Double(value) => write!(f, "{value}"),
        }
    }
}

/// JSON: an integer if the value is one.
impl Serialize for Number {
    fn serialize<S: Serializer>(&self, to: S) -> Result<S::Ok, S::Error> {
        match self.to_string().parse::<i64>() {
            Ok(whole) => to.serialize_i64(whole),
            Err(_) => to.serialize_f64(self.to_f64()),
        }
    }
}

impl fmt::Debug for Number {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::Display::fmt(self, f)
    }
}

#[cfg(test)]
mod tests {
    use super::Number;
    use proptest::prelude::*;

    fn number(value: f64) -> Number {
        Number::from_f64(value).unwrap()
    }

    #[test]
    fn decimals_are_exact() {
        assert_eq!(number(0.1).plus(number(0.2)).unwrap(), number(0.3));
        assert_eq!(number(1.0).over(number(3.0)).unwrap().times(number(3.0)).unwrap(), number(1.0));
        assert_eq!(number(1.0).over(number(3.0)).unwrap().to_string(), "1/3");
        assert_eq!(number(-12.5).to_string(), "-12.5");
        assert_eq!(number(-0.0).to_string(), "0");
    }

    #[test]
    fn what_has_no_result_says_so() {
        assert!(number(1.0).over(number(0.0)).is_err());
        assert!(number(1e300).times(number(1e300)).is_err());
        assert!(Number::from_f64(f64::NAN).is_none());
    }

    #[test]
    fn large_values_go_on_as_doubles() {
        let large = number(1e30).times(number(1e30)).unwrap();
        assert!(!large.is_exact());
        assert!(large > number(1e59));
    }

    #[test]
    fn order_is_exact_between_ratios_and_doubles() {
        let third = number(1.0).over(number(3.0)).unwrap();
        let double = Number(super::Form::Double(1.0 / 3.0));
        assert!(double < third, "the double is 0.333333333333333314…");
        assert!(number(1e300) > number(1e37));
        assert!(Number(super::Form::Double(0.1)) > number(0.1));
        assert!(Number(super::Form::Double(-0.5)) == number(-0.5));
        let (near, nearer) =
            (Number::ratio(i128::MAX / 2, i128::MAX), Number::ratio(i128::MAX / 2 + 1, i128::MAX));
        assert!(near < nearer);
    }

    proptest! {
        #[test]
        fn agrees_with_doubles(a in -1e9..1e9f64, b in -1e9..1e9f64) {
            let close = |x: Number, y: f64| (x.to_f64() - y).abs() <= 1e-6 * y.abs().max(1.0);
            prop_assert!(close(number(a).plus(number(b)).unwrap(), a + b));
            prop_assert!(close(number(a).minus(number(b)).unwrap(), a - b));
            prop_assert!(close(number(a).times(number(b)).unwrap(), a * b));
            prop_assert_eq!(number(a) < number(b), a < b);
            prop_assert_eq!(number(a).to_string(), a.to_string());
        }
    }
}
