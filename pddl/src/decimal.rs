//! Decimal numbers as they are written: 0.1 is a tenth, not the nearest double.
//!
//! Problem: whether a temporal plan is valid may depend on `0.003` and `4.003` being exact. Idea: store the
//! digits and how many of them follow the point; a caller that calculates makes a fraction of them, `digits
//! / 10^scale`. Invariant: there are no trailing zeros behind the point, so equal numbers are equal values;
//! the scale is at most [`Decimal::MAX_SCALE`], so that `10^scale` fits in an `i128`.

use std::cmp::Ordering;
use std::fmt;
use std::str::FromStr;

/// An exact decimal number.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Decimal {
    digits: i128,
    scale: u8,
}

/// A text is not a valid [`Decimal`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum NotADecimal {
    /// It is not a number.
    #[error("not a number")]
    Malformed,
    /// It has more digits than a [`Decimal`] holds.
    #[error("a number of more than {} digits", Decimal::MAX_SCALE)]
    TooLong,
}

impl Decimal {
    /// Zero.
    pub const ZERO: Self = Self { digits: 0, scale: 0 };

    /// Most digits behind the point.
    pub const MAX_SCALE: u8 = 37;

    /// A whole number.
    pub const fn whole(value: i64) -> Self {
        Self { digits: value as i128, scale: 0 }
    }

    /// All digits as one whole number: 4003 for 4.003.
    pub const fn digits(self) -> i128 {
        self.digits
    }

    /// How many of the digits stand behind the point: 3 for 4.003.
    pub const fn scale(self) -> u8 {
        self.scale
    }

    /// Its value as a fraction, not reduced: numerator and (positive) denominator.
    pub const fn fraction(self) -> (i128, i128) {
        (self.digits, 10i128.pow(self.scale as u32))
    }

    /// Whether it is below zero.
    pub const fn is_negative(self) -> bool {
        self.digits < 0
    }

    /// The nearest double.
    pub fn to_f64(self) -> f64 {
        // Through the text, because dividing two rounded numbers rounds once more.
        self.to_string().parse().unwrap_or(f64::NAN)
    }

    fn new(mut digits: i128, mut scale: i64) -> Result<Self, NotADecimal> {
        while digits != 0 && scale > 0 && digits % 10 == 0 {
            digits /= 10;
            scale -= 1;
        }
        if digits == 0 {
            return Ok(Self::ZERO);
        }
        while scale < 0 {
            digits = digits.checked_mul(10).ok_or(NotADecimal::TooLong)?;
            scale += 1;
        }
        match u8::try_from(scale) {
            Ok(scale) if scale <= Self::MAX_SCALE => Ok(Self { digits, scale }),
            _ => Err(NotADecimal::TooLong),
        }
    }
}

impl FromStr for Decimal {
    type Err = NotADecimal;

    /// `5`, `-1.5`, `.5`, `5.`, `1e-3`.
    fn from_str(text: &str) -> Result<Self, NotADecimal> {
        let (number, exponent) = match text.split_once(['e', 'E']) {
            Some((number, exponent)) => (number, Some(exponent)),
            None => (text, None),
        };
        let unsigned = number.strip_prefix(['-', '+']).unwrap_or(number);
        let negative = number.starts_with('-');
        let (before, behind) = unsigned.split_once('.').unwrap_or((unsigned, ""));
        let only_digits = |part: &str| part.bytes().all(|b| b.is_ascii_digit());
        if !only_digits(before) || !only_digits(behind) || before.len() + behind.len() == 0 {
            return Err(NotADecimal::Malformed);
        }
        let exponent = match exponent {
            Some(written) => {
                let unsigned = written.strip_prefix(['-', '+']).unwrap_or(written);
                if unsigned.is_empty() || !only_digits(unsigned) {
                    return Err(NotADecimal::Malformed);
                }
                // A number with such an exponent is zero or too long, which is found below.
                written.parse::<i64>().unwrap_or(i64::MAX / 2).clamp(-1_000_000, 1_000_000)
            }
            None => 0,
        };
        let behind = behind.trim_end_matches('0');
        let mut digits: i128 = 0;
        for digit in before.bytes().chain(behind.bytes()) {
            let digit = i128::from(digit - b'0');
            digits = digits.checked_mul(10).and_then(|d| d.checked_add(digit)).ok_or(NotADecimal::TooLong)?;
        }
        let scale = i64::try_from(behind.len()).map_err(|_| NotADecimal::TooLong)?;
        Self::new(if negative { -digits } else { digits }, scale - exponent)
    }
}

impl fmt::Display for Decimal {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (digits, one) = (self.digits.unsigned_abs(), 10u128.pow(u32::from(self.scale)));
        let sign = if self.is_negative() { "-" } else { "" };
        write!(f, "{sign}{}", digits / one)?;
        if self.scale > 0 {
            write!(f, ".{:0width$}", digits % one, width = usize::from(self.scale))?;
        }
        Ok(())
    }
}

impl Ord for Decimal {
    fn cmp(&self, other: &Self) -> Ordering {
        // Whole parts first; what is behind the point then fits when brought to one scale.
        let parts = |d: &Self| {
            let (digits, one) = d.fraction();
            (digits.div_euclid(one), digits.rem_euclid(one))
        };
        let ((a, mut behind_a), (b, mut behind_b)) = (parts(self), parts(other));
        let scale = self.scale.max(other.scale);
        behind_a *= 10i128.pow(u32::from(scale - self.scale));
        behind_b *= 10i128.pow(u32::from(scale - other.scale));
        a.cmp(&b).then(behind_a.cmp(&behind_b))
    }
}

impl PartialOrd for Decimal {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

#[cfg(test)]
mod tests {
    use super::{Decimal, NotADecimal};

    fn read(text: &str) -> Decimal {
        text.parse().unwrap_or_else(|e| panic!("{text}: {e}"))
    }

    #[test]
    fn what_is_written_is_what_it_is() {
        for (text, shown) in [
            ("4.000", "4"),
            ("0.0030", "0.003"),
            (".5", "0.5"),
            ("5.", "5"),
            ("1e-3", "0.001"),
            ("1.5E+2", "150"),
            ("-0.10", "-0.1"),
            ("-0.0", "0"),
            ("000100", "100"),
            ("0e999999999999999999999", "0"),
            ("0.1000000000000000055511151231257827", "0.1000000000000000055511151231257827"),
        ] {
            assert_eq!(read(text).to_string(), shown);
            assert_eq!(read(shown), read(text));
        }
        assert_eq!(read("4.003").fraction(), (4003, 1000));
        assert_eq!(read("0.1").to_f64(), 0.1);
    }

    #[test]
    fn order_is_that_of_the_numbers() {
        let ascending =
            ["-10", "-1.5", "-1.4999999999999999999999", "0", "0.003", "0.01", "1", "1e20", "1e37"];
        for (index, a) in ascending.iter().enumerate() {
            for (other, b) in ascending.iter().enumerate() {
                assert_eq!(read(a).cmp(&read(b)), index.cmp(&other), "{a} {b}");
            }
        }
    }

    #[test]
    fn what_is_no_number_or_has_too_many_digits_is_refused() {
        for text in ["", ".", "-", "1.2.3", "1e", "e5", "0x1", "1_000", "nan", "inf", "--1", "1 2"] {
            assert_eq!(text.parse::<Decimal>(), Err(NotADecimal::Malformed), "{text}");
        }
        for text in ["1e40", "1e-40", "1e99999999999999999999", &"9".repeat(50)] {
            assert_eq!(text.parse::<Decimal>(), Err(NotADecimal::TooLong), "{text}");
        }
    }
}
