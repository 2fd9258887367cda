//! The simplest fraction in an interval.

use num_rational::BigRational;
use num_traits::{One, Zero};

/// Returns the fraction with the smallest denominator inside the open interval; both ends are
/// positive or zero.
pub(crate) fn simplest(low: &BigRational, high: &BigRational) -> BigRational {
    let whole = low.floor() + BigRational::one();
    if whole < *high {
        return whole;
    }
    let floor = low.floor();
    let (low, high) = (low - &floor, high - &floor);
    // Between 0 and 1 the simplest fraction is the inverse of the simplest between the inverses.
    let inner = if low.is_zero() {
        high.recip().floor() + BigRational::one()
    } else {
        simplest(&high.recip(), &low.recip())
    };
    floor + inner.recip()
}

#[cfg(test)]
mod tests {
    use super::simplest;
    use num_rational::BigRational;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn the_simplest_fraction_is_inside(a in 0_i64..1000, b in 1_i64..1000, c in 1_i64..1000) {
            let low = BigRational::new(a.into(), b.into());
            let high = &low + BigRational::new(1.into(), c.into());
            let found = simplest(&low, &high);
            prop_assert!(low < found && found < high);
            for denominator in 1..i64::try_from(found.denom().clone()).unwrap() {
                let next = (&low * BigRational::from_integer(denominator.into())).floor() + BigRational::from_integer(1.into());
                prop_assert!(next / BigRational::from_integer(denominator.into()) >= high);
            }
        }
    }
}
