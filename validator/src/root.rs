//! Exact instants at which a curve is zero.
//!
//! Problem: a ball that falls 2 metres lands after the square root of 0.4 seconds, which is irrational. The nearest
//! double lies on the wrong side of the root, so a condition that holds at that instant alone (a curve that touches
//! zero, `>=` against `>`) would be missed, and two instants could be in the wrong order. Idea: an irrational root is
//! a polynomial and an interval that contains no other root of it (an isolating interval, by Sturm's theorem). Order
//! and signs are decided by narrowing the interval, equality by the greatest common divisor of two polynomials, all
//! in fractions of unbounded integers.
//!
//! Invariant: the polynomial of a root has simple roots only, exactly one lies in the interval, and that one is
//! irrational. A rational root is recognised, because only the simplest fraction in a narrow interval can be a root.
//!
//! Cost: nothing for curves of the first degree, whose roots are fractions. Halvings of the interval are counted, and
//! beyond the bound the result is [`Undecided`].
//!
//! Source: Basu, Pollack & Roy, "Algorithms in Real Algebraic Geometry", 2006 (Sturm sequences, isolating lists).

use crate::fraction::simplest;
use crate::number::Number;
use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::{One, Signed, ToPrimitive, Zero};
use std::cmp::Ordering;
use std::sync::Arc;

/// The most halvings of the interval for one question.
const MOST_HALVINGS: usize = 4_000;

/// The limit was reached.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Undecided;

type Result<T> = std::result::Result<T, Undecided>;

/// A polynomial with rational coefficients; the last coefficient is not zero.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Polynomial(Vec<BigRational>);

/// A time since the last happening.
#[derive(Clone, Debug)]
pub(crate) enum Instant {
    /// A fraction.
    At(Number),
    /// An irrational root.
    Root(Root),
}

/// An irrational root.
#[derive(Clone, Debug)]
pub(crate) struct Root {
    /// The polynomial, its derivative, and the negated remainders.
    sequence: Arc<[Polynomial]>,
    low: BigRational,
    high: BigRational,
}

impl Polynomial {
    pub(crate) fn new(coefficients: impl IntoIterator<Item = Number>) -> Self {
        Self::trimmed(coefficients.into_iter().map(Number::to_rational).collect())
    }

    fn trimmed(mut coefficients: Vec<BigRational>) -> Self {
        while coefficients.last().is_some_and(Zero::is_zero) {
            coefficients.pop();
        }
        Self(coefficients)
    }

    fn is_constant(&self) -> bool {
        self.0.len() <= 1
    }

    fn at(&self, point: &BigRational) -> BigRational {
        self.0.iter().rev().fold(BigRational::zero(), |value, c| value * point + c)
    }

    pub(crate) fn sign(&self, point: &BigRational) -> Ordering {
        self.at(point).cmp(&BigRational::zero())
    }

    fn derivative(&self) -> Self {
        let mut power = BigRational::zero();
        let rest = self.0.iter().skip(1).map(|c| {
            power += BigRational::one();
            c * &power
        });
        Self::trimmed(rest.collect())
    }

    /// The polynomial with leading coefficient 1 or −1: smaller numbers, the same signs.
    fn scaled(mut self) -> Self {
        if let Some(last) = self.0.last().map(Signed::abs) {
            self.0.iter_mut().for_each(|c| *c /= &last);
        }
        self
    }

    /// The quotient and the remainder; the divisor is not zero.
    fn divided(&self, divisor: &Self) -> (Self, Self) {
        let mut rest = self.0.clone();
        let Some((last, others)) = divisor.0.split_last() else { return (Self(Vec::new()), Self(rest)) };
        let mut quotient = vec![BigRational::zero(); (rest.len() + 1).saturating_sub(divisor.0.len())];
        for place in (0..quotient.len()).rev() {
            let Some(top) = rest.pop() else { break };
            let factor = top / last;
            for (target, c) in rest[place..].iter_mut().zip(others) {
                *target -= &factor * c;
            }
            quotient[place] = factor;
        }
        (Self::trimmed(quotient), Self::trimmed(rest))
    }

    fn greatest_common_divisor(&self, other: &Self) -> Self {
        let (mut a, mut b) = (self.clone(), other.clone());
        while !b.0.is_empty() {
            let rest = a.divided(&b).1.scaled();
            (a, b) = (b, rest);
        }
        a
    }

    /// The Sturm sequence of the polynomial with the same roots, each of them simple.
    fn sequence(&self) -> Arc<[Self]> {
        let common = self.greatest_common_divisor(&self.derivative());
        let simple = self.divided(&common).0.scaled();
        let mut sequence = vec![simple.clone(), simple.derivative().scaled()];
        while let [.., before, last] = sequence.as_slice()
            && !last.is_constant()
        {
            let mut rest = before.divided(last).1.scaled();
            rest.0.iter_mut().for_each(|c| *c = -&*c);
            if rest.0.is_empty() {
                break;
            }
            sequence.push(rest);
        }
        sequence.into()
    }

    /// The roots of a polynomial of degree two; `None` unless both are fractions that 128 bits
    /// hold, or no real root exists.
    fn fractions_of_second_degree(&self, from: Number, to: Number) -> Option<Vec<Instant>> {
        let [c, b, a] = self.0.as_slice() else { return None };
        let two = BigRational::from_integer(2.into());
        let under = b * b - a * c * &two * &two;
        if under.is_negative() {
            return Some(Vec::new());
        }
        let square = under.numer() * under.denom();
        let side = square.sqrt();
        if &side * &side != square {
            return None;
        }
        let root = BigRational::new(side, under.denom().clone());
        let mut found = Vec::with_capacity(2);
        for sign in [-&root, root] {
            let instant = Number::of_rational(&((sign - b) / (a * &two)))?;
            if from < instant && instant < to && !found.contains(&instant) {
                found.push(instant);
            }
        }
        found.sort();
        Some(found.into_iter().map(Instant::At).collect())
    }

    /// Its roots inside the open interval, in order. A polynomial that is zero everywhere has none.
    pub(crate) fn roots(&self, from: Number, to: Number) -> Result<Vec<Instant>> {
        if self.is_constant() {
            return Ok(Vec::new());
        }
        if let Some(found) = self.fractions_of_second_degree(from, to) {
            return Ok(found);
        }
        let mut search = Search { sequence: self.sequence(), halvings: 0, found: Vec::new() };
        search.isolate(&from.to_rational(), &to.to_rational())?;
        Ok(search.found)
    }
}

/// The number of sign changes of the sequence at a point.
fn changes(sequence: &[Polynomial], point: &BigRational) -> usize {
    let signs = sequence.iter().map(|p| p.sign(point)).filter(|sign| sign.is_ne());
    let (mut changes, mut last) = (0, None);
    for sign in signs {
        changes += usize::from(last.is_some_and(|last| last != sign));
        last = Some(sign);
    }
    changes
}

/// The number of roots inside the open interval.
fn count(sequence: &[Polynomial], from: &BigRational, to: &BigRational) -> usize {
    let half_open = changes(sequence, from).saturating_sub(changes(sequence, to));
    half_open.saturating_sub(usize::from(sequence[0].sign(to).is_eq()))
}

fn middle(a: &BigRational, b: &BigRational) -> BigRational {
    (a + b) / BigRational::from_integer(2.into())
}

/// The isolation of roots.
struct Search {
    sequence: Arc<[Polynomial]>,
    halvings: usize,
    found: Vec<Instant>,
}

impl Search {
    fn halve(&mut self) -> Result<()> {
        self.halvings += 1;
        if self.halvings > MOST_HALVINGS { Err(Undecided) } else { Ok(()) }
    }

    fn isolate(&mut self, from: &BigRational, to: &BigRational) -> Result<()> {
        match count(&self.sequence, from, to) {
            0 => Ok(()),
            1 => self.narrow(from.clone(), to.clone()),
            _ => {
                self.halve()?;
                let middle = middle(from, to);
                self.isolate(from, &middle)?;
                if self.sequence[0].sign(&middle).is_eq() {
                    self.found.push(Instant::At(Number::of_rational(&middle).ok_or(Undecided)?));
                }
                self.isolate(&middle, to)
            }
        }
    }

    /// Narrows the interval of one root until at most one fraction in it can be the root.
    fn narrow(&mut self, mut low: BigRational, mut high: BigRational) -> Result<()> {
        let polynomial = &Arc::clone(&self.sequence)[0];
        // With integer coefficients, the denominator of a rational root divides the leading
        // coefficient; `apart` is the least distance of two such fractions.
        let multiple =
            polynomial.0.iter().fold(BigInt::one(), |all, c| num_integer::lcm(all, c.denom().clone()));
        let first =
            polynomial.0.last().map_or_else(BigRational::one, |c| c * BigRational::from_integer(multiple));
        let apart = (&first * &first).recip();
        // The signs at the ends differ, so the sign in the middle decides the half.
        let mut below = polynomial.sign(&low);
        while &high - &low >= apart {
            self.halve()?;
            let middle = middle(&low, &high);
            if polynomial.sign(&middle).is_eq() {
                self.found.push(Instant::At(Number::of_rational(&middle).ok_or(Undecided)?));
                return Ok(());
            }
            let sign = polynomial.sign(&middle);
            let is_left =
                if below.is_ne() { sign != below } else { count(&self.sequence, &low, &middle) == 1 };
            if is_left {
                high = middle;
            } else {
                (low, below) = (middle, sign);
            }
        }
        let fraction = simplest(&low, &high);
        self.found.push(if polynomial.sign(&fraction).is_eq() {
            Instant::At(Number::of_rational(&fraction).ok_or(Undecided)?)
        } else {
            Instant::Root(Root { sequence: Arc::clone(&self.sequence), low, high })
        });
        Ok(())
    }
}

impl Root {
    fn halve(&mut self) {
        let middle = middle(&self.low, &self.high);
        // The middle is a fraction, so it is not the root.
        if count(&self.sequence, &self.low, &middle) == 1 { self.high = middle } else { self.low = middle }
    }

    /// Compares the root with a fraction; they are never equal.
    fn compared_with(&self, point: &BigRational) -> Ordering {
        if *point <= self.low {
            Ordering::Greater
        } else if *point >= self.high || count(&self.sequence, &self.low, point) == 1 {
            Ordering::Less
        } else {
            Ordering::Greater
        }
    }

    fn compared(&self, other: &Self) -> Result<Ordering> {
        let (mut one, mut two) = (self.clone(), other.clone());
        let common = one.sequence[0].greatest_common_divisor(&two.sequence[0]);
        let common = (!common.is_constant()).then(|| common.sequence());
        for _ in 0..MOST_HALVINGS {
            if one.high <= two.low {
                return Ok(Ordering::Less);
            }
            if two.high <= one.low {
                return Ok(Ordering::Greater);
            }
            let (low, high) = ((&one.low).max(&two.low), (&one.high).min(&two.high));
            // A common root inside both intervals is the root of both.
            if common.as_ref().is_some_and(|common| count(common, low, high) > 0) {
                return Ok(Ordering::Equal);
            }
            one.halve();
            two.halve();
        }
        Err(Undecided)
    }

    /// The sign of another polynomial at the root.
    pub(crate) fn sign_of(&self, other: &Polynomial) -> Result<Ordering> {
        let Some(constant) = other.0.first() else { return Ok(Ordering::Equal) };
        if other.is_constant() {
            return Ok(constant.cmp(&BigRational::zero()));
        }
        let mut root = self.clone();
        let common = self.sequence[0].greatest_common_divisor(other);
        if !common.is_constant() && count(&common.sequence(), &root.low, &root.high) > 0 {
            return Ok(Ordering::Equal);
        }
        let others = other.sequence();
        for _ in 0..MOST_HALVINGS {
            let sign = other.sign(&root.high);
            if sign.is_ne() && count(&others, &root.low, &root.high) == 0 {
                return Ok(sign);
            }
            root.halve();
        }
        Err(Undecided)
    }

    /// A double that is as close to the root as doubles can be.
    pub(crate) fn near(&self) -> Number {
        let mut root = self.clone();
        let enough = BigRational::new(1.into(), BigInt::one() << 60);
        for _ in 0..MOST_HALVINGS {
            if &root.high - &root.low < &enough * root.high.abs().max(enough.clone()) {
                break;
            }
            root.halve();
        }
        Number::rounded(root.low.to_f64().unwrap_or(f64::MAX))
    }
}

impl Instant {
    /// The instant as a number, or a number close to it.
    pub(crate) fn near(&self) -> Number {
        match self {
            Self::At(number) => *number,
            Self::Root(root) => root.near(),
        }
    }

    /// Compares two instants.
    pub(crate) fn compared(&self, other: &Self) -> Result<Ordering> {
        match (self, other) {
            (Self::At(one), Self::At(two)) => Ok(one.cmp(two)),
            (Self::Root(one), Self::Root(two)) => one.compared(two),
            (Self::Root(root), Self::At(point)) => Ok(root.compared_with(&point.to_rational())),
            (Self::At(point), Self::Root(root)) => Ok(root.compared_with(&point.to_rational()).reverse()),
        }
    }

    /// A fraction between this instant and a later one.
    pub(crate) fn between(&self, later: &Self) -> Result<Number> {
        let (mut one, mut two) = (self.clone(), later.clone());
        for _ in 0..MOST_HALVINGS {
            let low = match &one {
                Self::At(number) => number.to_rational(),
                Self::Root(root) => root.high.clone(),
            };
            let high = match &two {
                Self::At(number) => number.to_rational(),
                Self::Root(root) => root.low.clone(),
            };
            if low < high {
                return Number::of_rational(&simplest(&low, &high)).ok_or(Undecided);
            }
            for side in [&mut one, &mut two] {
                if let Self::Root(root) = side {
                    root.halve();
                }
            }
        }
        Err(Undecided)
    }
}

/// Sorts instants and removes duplicates.
pub(crate) fn in_order(instants: Vec<Instant>) -> Result<Vec<Instant>> {
    let mut fault = None;
    let mut order = |a: &Instant, b: &Instant| match a.compared(b) {
        Ok(order) => order,
        Err(undecided) => {
            fault = Some(undecided);
            Ordering::Equal
        }
    };
    let mut sorted: Vec<Instant> = Vec::with_capacity(instants.len());
    for instant in instants {
        // Usually there are few, and they are sorted already.
        let place = sorted.binary_search_by(|other| order(other, &instant));
        if let Err(place) = place {
            sorted.insert(place, instant);
        }
    }
    fault.map_or(Ok(sorted), Err)
}

#[cfg(test)]
mod tests {
    use super::{Instant, Polynomial, in_order};
    use crate::number::Number;
    use proptest::prelude::*;
    use std::cmp::Ordering;

    fn polynomial(coefficients: &[i64]) -> Polynomial {
        Polynomial::new(coefficients.iter().map(|&c| Number::integer(c)))
    }

    fn roots(coefficients: &[i64], to: i64) -> Vec<Instant> {
        polynomial(coefficients).roots(Number::ZERO, Number::integer(to)).unwrap()
    }

    fn shown(instants: &[Instant]) -> Vec<String> {
        let show = |instant: &Instant| match instant {
            Instant::At(number) => number.to_string(),
            Instant::Root(root) => format!("~{:.6}", root.near().to_f64()),
        };
        instants.iter().map(show).collect()
    }

    #[test]
    fn roots_are_fractions_or_not() {
        assert_eq!(shown(&roots(&[-2, 0, 1], 5)), ["~1.414214"]);
        assert_eq!(shown(&roots(&[-4, 0, 1], 5)), ["2"]);
        assert_eq!(shown(&roots(&[-1, 7, -6], 5)), ["1/6", "1"]);
        assert_eq!(shown(&roots(&[4, 0, -4, 0, 1], 5)), ["~1.414214"], "a curve that only touches zero");
        assert_eq!(shown(&roots(&[0, -2, 0, 1], 5)), ["~1.414214"], "the ends do not belong to the interval");
        assert_eq!(shown(&roots(&[1, 0, 1], 5)), [""; 0]);
    }

    #[test]
    fn near_roots_are_told_apart() {
        // √2 and a fraction that agrees with it to 15 digits, and the same root of two different
        // polynomials.
        let root = &roots(&[-2, 0, 1], 5)[0];
        let near =
            Instant::At(Number::integer(886_731_088_897).over(Number::integer(627_013_566_048)).unwrap());
        assert_eq!(root.compared(&near).unwrap(), Ordering::Less);
        let same = &roots(&[6, -2, -3, 1], 2)[0];
        assert_eq!(root.compared(same).unwrap(), Ordering::Equal);
        assert_eq!(in_order(vec![near, same.clone(), root.clone()]).unwrap().len(), 2);
        let Instant::Root(root) = root else { panic!("irrational") };
        assert_eq!(root.sign_of(&polynomial(&[-4, 0, 0, 0, 1])).unwrap(), Ordering::Equal);
        assert_eq!(root.sign_of(&polynomial(&[-3, 0, 1])).unwrap(), Ordering::Less);
        assert_eq!(root.sign_of(&polynomial(&[-1_414_213_562, 1_000_000_000])).unwrap(), Ordering::Greater);
    }

    proptest! {
        #![proptest_config(ProptestConfig { cases: 64, ..ProptestConfig::default() })]

        #[test]
        fn products_have_the_roots_of_their_factors(
            whole in prop::collection::btree_set(1_i64..30, 0..3),
            squares in prop::collection::btree_set(prop::sample::select(vec![2_i64, 3, 5, 6, 7, 8, 10]), 0..3),
        ) {
            let times = |a: Vec<i64>, b: &[i64]| {
                let mut product = vec![0; a.len() + b.len() - 1];
                for (i, x) in a.iter().enumerate() {
                    for (j, y) in b.iter().enumerate() {
                        product[i + j] += x * y;
                    }
                }
                product
            };
            let mut product = vec![1];
            for &root in &whole {
                product = times(product, &[-root, 1]);
            }
            for &square in &squares {
                product = times(product, &[-square, 0, 1]);
            }
            let mut expected: Vec<f64> = whole.iter().map(|&w| w as f64).collect();
            expected.extend(squares.iter().map(|&s| (s as f64).sqrt()));
            expected.sort_by(f64::total_cmp);
            let found = roots(&product, 100);
            prop_assert_eq!(found.len(), expected.len());
            for (instant, value) in found.iter().zip(expected) {
                prop_assert!((instant.near().to_f64() - value).abs() < 1e-12);
                prop_assert_eq!(matches!(instant, Instant::At(_)), value.fract() == 0.0);
            }
            for pair in found.windows(2) {
                let between = Instant::At(pair[0].between(&pair[1]).unwrap());
                prop_assert_eq!(pair[0].compared(&between).unwrap(), Ordering::Less);
                prop_assert_eq!(between.compared(&pair[1]).unwrap(), Ordering::Less);
            }
        }

    }
}
