//! Numbers in states: their layout, the effects of operators, and comparisons.
//!
//! Problem: heuristics, successor trees and goals support only bits. Idea: the numbers of a state
//! follow its bits in the same record. Every comparison that some condition reads has its own bit,
//! which is computed again whenever an operator changes a number that it reads. All other code
//! reads only bits. Invariant: in every state that a task creates, the bit of a comparison is
//! correct, and numbers are exact. If the values of all effects stay multiples of one fraction, a
//! number is a multiple in one word; otherwise, or if numbers come from outside, it is a ratio in two words. If the result of a step
//! does not fit, the caller gets an error, and a search that therefore drops a state proves
//! nothing. Cost: per operator, the changed numbers and the comparisons that read them.

use super::{Literals, set, unset};
use crate::ids::{FactId, FluentId, id32};
use crate::number::{Change, Expression, Influence, NoValue, Number, Relation};
use pddl::model::{GroundApplication, Idx};
use rustc_hash::FxHashMap;

/// A numeric fluent that changes.
#[derive(Clone, Debug)]
pub(crate) struct Fluent {
    pub(crate) application: GroundApplication,
    pub(crate) initial: Option<Number>,
    /// Whether an outside event may give it any value.
    pub(crate) sensed: bool,
}

/// A fact that is defined by a comparison of numbers.
#[derive(Clone, Debug)]
pub(crate) struct Comparison {
    pub(crate) fact: FactId,
    pub(crate) relation: Relation,
    pub(crate) expression: Expression<FluentId>,
    /// Whether operators only add constants to its fluents.
    pub(super) steady: bool,
    /// The sum that it bounds from below. Comparisons that differ only in their bound have the same
    /// sum.
    pub(super) sum: Option<u32>,
    fast: Option<Fast>,
}

/// A change of one fluent.
#[derive(Clone, Debug)]
pub(crate) struct Update {
    pub(crate) condition: Literals,
    pub(crate) fluent: FluentId,
    pub(crate) change: Change,
    /// The new value; `None` makes the fluent undefined.
    pub(crate) value: Option<Expression<FluentId>>,
    fast: Option<Fast>,
}

impl Update {
    pub(crate) fn new(
        condition: Literals,
        fluent: FluentId,
        change: Change,
        value: Option<Expression<FluentId>>,
    ) -> Self {
        Self { condition, fluent, change, value, fast: None }
    }
}

/// The effects of an operator on numbers.
#[derive(Clone, Debug, Default)]
pub(crate) struct NumericEffects {
    pub(crate) updates: Box<[Update]>,
    /// Changes of fluents that only the metric reads; states do not hold these.
    pub(crate) metric: Box<[Update]>,
    /// The positions of the comparisons that read updated fluents.
    pub(crate) rechecked: Box<[u32]>,
}

/// A weighted sum of words, in units of the layout's fraction.
#[derive(Clone, Debug)]
struct Fast {
    terms: Box<[(u32, i64)]>,
    constant: i128,
    divisor: i128,
}

/// The layout of numbers in words.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Layout {
    /// One word: a multiple of `1 / scale`.
    Multiple(i64),
    /// Two words: numerator and denominator.
    Ratio,
}

/// An undefined value, as a multiple.
const NOTHING: i64 = i64::MIN;
/// The largest useful common denominator.
const LARGEST_SCALE: i128 = 1_000_000_000;

/// The numeric part of a task.
#[derive(Clone, Debug)]
pub(crate) struct Numeric {
    /// The first word of numbers in a state.
    start: usize,
    layout: Layout,
    /// The fluents in states, then those that only the metric reads.
    pub(crate) fluents: Box<[Fluent]>,
    pub(crate) stored: usize,
    pub(crate) comparisons: Box<[Comparison]>,
}

impl Default for Numeric {
    fn default() -> Self {
        Self {
            start: 0,
            layout: Layout::Multiple(1),
            fluents: Box::default(),
            stored: 0,
            comparisons: Box::default(),
        }
    }
}

impl Numeric {
    /// `start` is the number of words of facts; the first `stored` fluents are in states. Also
    /// prepares the operators' effects.
    pub(crate) fn new<'e>(
        start: usize,
        fluents: Vec<Fluent>,
        stored: usize,
        comparisons: Vec<(FactId, Relation, Expression<FluentId>)>,
        effects: impl Iterator<Item = &'e mut NumericEffects>,
    ) -> Self {
        let mut effects: Vec<&mut NumericEffects> = effects.collect();
        let updates = effects.iter().flat_map(|e| e.updates.iter());
        let layout = match common_scale(&fluents[..stored], updates) {
            Some(scale) => Layout::Multiple(scale),
            None => Layout::Ratio,
        };
        let mut numeric = Self { start, layout, fluents: fluents.into(), stored, ..Self::default() };
        let mut sums: FxHashMap<Vec<(FluentId, Number)>, u32> = FxHashMap::default();
        let comparison = |(fact, relation, expression): (FactId, Relation, Expression<FluentId>)| {
            let fast = numeric.fast(&expression);
            let steady = matches!(expression, Expression::Linear(_));
            let sum = match (&expression, relation) {
                (Expression::Linear(linear), Relation::Positive | Relation::NonNegative) => {
                    let new = id32(sums.len());
                    Some(*sums.entry(linear.terms.clone()).or_insert(new))
                }
                _ => None,
            };
            Comparison { fact, relation, expression, steady, sum, fast }
        };
        numeric.comparisons = comparisons.into_iter().map(comparison).collect();
        let mut readers: Vec<Vec<u32>> = vec![Vec::new(); stored];
        for (position, comparison) in (0..).zip(&numeric.comparisons) {
            comparison.expression.each_fluent(&mut |f| readers[f.index()].push(position));
        }
        for effect in &mut effects {
            for update in &mut effect.updates {
                update.fast = update.value.as_ref().and_then(|value| numeric.fast(value));
                let constant = update.value.as_ref().is_some_and(|value| value.as_constant().is_some());
                if update.change != Change::Shift || !constant {
                    for &reader in &readers[update.fluent.index()] {
                        numeric.comparisons[reader as usize].steady = false;
                    }
                }
            }
            let read = effect.updates.iter().flat_map(|u| readers[u.fluent.index()].iter().copied());
            let mut rechecked: Vec<u32> = read.collect();
            rechecked.sort_unstable();
            rechecked.dedup();
            effect.rechecked = rechecked.into();
        }
        numeric
    }

    /// The number of words of a state that hold numbers.
    pub(crate) fn words(&self) -> usize {
        match self.layout {
            Layout::Multiple(_) => self.stored,
            Layout::Ratio => 2 * self.stored,
        }
    }

    #[expect(clippy::cast_possible_wrap, reason = "words hold the bits of signed numbers")]
    pub(crate) fn value(&self, words: &[u64], fluent: FluentId) -> Option<Number> {
        let i = fluent.index();
        match self.layout {
            Layout::Multiple(scale) => {
                let word = words[self.start + i] as i64;
                if word == NOTHING {
                    None
                } else if scale == 1 {
                    Some(Number::integer(word))
                } else {
                    Number::ratio(i128::from(word), i128::from(scale))
                }
            }
            Layout::Ratio => {
                let numerator = words[self.start + 2 * i] as i64;
                Number::ratio(i128::from(numerator), i128::from(words[self.start + 2 * i + 1] as i64))
            }
        }
    }

    /// Writes a number. Returns whether it fits; one that does not fit is written as undefined.
    #[expect(clippy::cast_sign_loss, reason = "words hold the bits of signed numbers")]
    pub(crate) fn set(&self, words: &mut [u64], fluent: FluentId, value: Option<Number>) -> bool {
        let i = fluent.index();
        let short = |n: i128| i64::try_from(n).ok().filter(|&n| n != NOTHING);
        match self.layout {
            Layout::Multiple(scale) => {
                let multiple = |number: Number| {
                    let all = number.numerator().checked_mul(i128::from(scale))?;
                    (all % number.denominator() == 0).then(|| short(all / number.denominator()))?
                };
                let word = value.map_or(Some(NOTHING), multiple);
                words[self.start + i] = word.unwrap_or(NOTHING) as u64;
                word.is_some()
            }
            Layout::Ratio => {
                let ratio = |number: Number| Some((short(number.numerator())?, short(number.denominator())?));
                let both = value.map_or(Some((0, 0)), ratio);
                let (numerator, denominator) = both.unwrap_or((0, 0));
                words[self.start + 2 * i] = numerator as u64;
                words[self.start + 2 * i + 1] = denominator as u64;
                both.is_some()
            }
        }
    }

    /// Writes the initial values and the bits of all comparisons. Returns whether all numbers fit.
    pub(crate) fn initialise(&self, words: &mut [u64]) -> bool {
        let mut fit = true;
        for (i, fluent) in self.fluents[..self.stored].iter().enumerate() {
            fit &= self.set(words, FluentId::from_index(i), fluent.initial);
        }
        self.compare_all(words) && fit
    }

    /// Sets the bit of every comparison. Returns whether all their values fit; a comparison whose
    /// value does not fit counts as false.
    pub(crate) fn compare_all(&self, words: &mut [u64]) -> bool {
        let mut fit = true;
        for comparison in &self.comparisons {
            if !self.compare(comparison, words) {
                unset(words, comparison.fact);
                fit = false;
            }
        }
        fit
    }

    /// Applies an operator's changes to `next`, a copy of `state`. Returns whether all numbers fit.
    pub(crate) fn apply(&self, effects: &NumericEffects, state: &[u64], next: &mut [u64]) -> bool {
        let mut updates = effects.updates.iter().filter(|u| u.condition.hold_in(state));
        let mut rechecked = effects.rechecked.iter().map(|&position| &self.comparisons[position as usize]);
        updates.all(|update| self.update(update, state, next))
            && rechecked.all(|comparison| self.compare(comparison, next))
    }

    #[expect(clippy::cast_sign_loss, clippy::cast_possible_wrap, reason = "words hold signed numbers' bits")]
    fn update(&self, update: &Update, state: &[u64], next: &mut [u64]) -> bool {
        // The common case: additions and assignments of multiples.
        if let (Layout::Multiple(_), Some(fast), Change::Shift | Change::Assign) =
            (self.layout, &update.fast, update.change)
        {
            let at = self.start + update.fluent.index();
            let before = if update.change == Change::Shift { next[at] as i64 } else { 0 };
            let sum = self.sum(fast, state).filter(|s| before != NOTHING && s % fast.divisor == 0);
            let after = sum.and_then(|sum| i64::try_from(i128::from(before) + sum / fast.divisor).ok());
            if let Some(after) = after.filter(|&a| a != NOTHING) {
                next[at] = after as u64;
                return true;
            }
        }
        let value = match update.value.as_ref().map(|v| v.evaluate(&|&f| self.value(state, f))) {
            None | Some(Err(NoValue::Undefined)) => None,
            Some(Ok(value)) => Some(value),
            Some(Err(NoValue::Overflow)) => return false,
        };
        let before = self.value(next, update.fluent);
        let after = changed(update.change, before, value);
        if after.is_none() && value.is_some() && before.is_some() {
            return false;
        }
        self.set(next, update.fluent, after)
    }

    pub(super) fn influence(&self, update: &Update, comparison: &Comparison) -> Influence {
        let compared = (comparison.relation, &comparison.expression);
        Influence::of(compared, &update.fluent, update.change, update.value.as_ref())
    }

    /// Sets the comparison's bit. Returns whether its value fits.
    fn compare(&self, comparison: &Comparison, words: &mut [u64]) -> bool {
        match self.holds(comparison, words) {
            Some(true) => set(words, comparison.fact),
            Some(false) => unset(words, comparison.fact),
            None => return false,
        }
        true
    }

    /// `None` if the value does not fit.
    fn holds(&self, comparison: &Comparison, words: &[u64]) -> Option<bool> {
        if let Some(fast) = &comparison.fast {
            let sum = self.sum(fast, words);
            let holds = |s: i128| comparison.relation.holds(i32::from(s > 0) - i32::from(s < 0));
            return Some(sum.is_some_and(holds));
        }
        match comparison.expression.evaluate(&|&f| self.value(words, f)) {
            Ok(value) => Some(comparison.relation.holds(value.sign())),
            Err(NoValue::Undefined) => Some(false),
            Err(NoValue::Overflow) => None,
        }
    }

    /// The number 1 in the units of [`measure`](Self::measure) for this comparison.
    pub(super) fn unit(&self, comparison: &Comparison) -> Number {
        match (self.layout, &comparison.fast) {
            (Layout::Multiple(scale), Some(fast)) => {
                let unit =
                    i128::from(scale).checked_mul(fast.divisor).and_then(|unit| Number::ratio(unit, 1));
                unit.expect("a scale and a divisor are small")
            }
            _ => Number::ONE,
        }
    }

    /// The value of a comparison's expression in its own units, to 15 digits.
    #[expect(clippy::cast_precision_loss, reason = "estimates take the first digits")]
    pub(super) fn measure(&self, comparison: &Comparison, words: &[u64]) -> Option<f64> {
        match &comparison.fast {
            Some(fast) => self.sum(fast, words).map(|sum| sum as f64),
            None => comparison.expression.evaluate(&|&f| self.value(words, f)).ok().map(Number::to_f64),
        }
    }

    /// `divisor` times the value; `None` if some fluent is undefined.
    #[expect(clippy::cast_possible_wrap, reason = "words hold the bits of signed numbers")]
    fn sum(&self, fast: &Fast, words: &[u64]) -> Option<i128> {
        let mut sum = fast.constant;
        for &(fluent, coefficient) in &fast.terms {
            let word = words[self.start + fluent as usize] as i64;
            if word == NOTHING {
                return None;
            }
            // Each factor is below 2^63, and there are too few terms to exceed 127 bits.
            sum += i128::from(coefficient) * i128::from(word);
        }
        Some(sum)
    }

    fn fast(&self, expression: &Expression<FluentId>) -> Option<Fast> {
        const SMALL: i128 = 1 << 40;
        let (Layout::Multiple(scale), Expression::Linear(linear)) = (self.layout, expression) else {
            return None;
        };
        let constant = linear.constant.times(Number::integer(scale))?;
        let divisor = linear.terms.iter().try_fold(constant.denominator(), |all, (_, coefficient)| {
            common_multiple(all, coefficient.denominator()).filter(|&m| m < SMALL)
        })?;
        let whole = |number: Number| number.numerator().checked_mul(divisor / number.denominator());
        let term = |(fluent, coefficient): &(FluentId, Number)| {
            let factor = whole(*coefficient).filter(|f| f.abs() < SMALL)?;
            (fluent.index() < self.stored).then_some((fluent.0, i64::try_from(factor).ok()?))
        };
        let constant = whole(constant).filter(|c| c.abs() < SMALL * SMALL)?;
        Some(Fast { terms: linear.terms.iter().map(term).collect::<Option<_>>()?, constant, divisor })
    }
}

/// The fluent's value after a change; `None` if it is then undefined.
pub(crate) fn changed(change: Change, before: Option<Number>, value: Option<Number>) -> Option<Number> {
    match change {
        Change::Assign => value,
        Change::Shift => before?.plus(value?),
        Change::Scale => before?.times(value?),
    }
}

fn common_multiple(a: i128, b: i128) -> Option<i128> {
    let (mut x, mut y) = (a, b);
    while y != 0 {
        (x, y) = (y, x % y);
    }
    (a / x).checked_mul(b)
}

/// The common denominator of all numbers, if there is one.
fn common_scale<'u>(fluents: &[Fluent], updates: impl Iterator<Item = &'u Update> + Clone) -> Option<i64> {
    if fluents.iter().any(|fluent| fluent.sensed) {
        return None;
    }
    let add = |scale: i128, number: Number| {
        common_multiple(scale, number.denominator()).filter(|&s| s <= LARGEST_SCALE)
    };
    let mut scale = fluents.iter().filter_map(|f| f.initial).try_fold(1, add)?;
    for update in updates.clone().filter(|u| u.change != Change::Scale) {
        if let Some(Expression::Linear(linear)) = &update.value {
            scale = add(scale, linear.constant)?;
        }
    }
    let whole = |number: &Number| number.denominator() == 1;
    let keeps = |update: &Update| match (&update.value, update.change) {
        (None, _) => true,
        (Some(Expression::Linear(linear)), Change::Scale) => {
            let factors = linear.terms.iter().map(|(_, c)| c);
            whole(&linear.constant) && factors.clone().all(whole) && (scale == 1 || factors.len() == 0)
        }
        (Some(Expression::Linear(linear)), _) => linear.terms.iter().all(|(_, c)| whole(c)),
        (Some(tree), _) => scale == 1 && is_whole(tree),
    };
    updates.into_iter().all(keeps).then(|| i64::try_from(scale).ok())?
}

/// Whether the expression maps integers to integers.
fn is_whole(expression: &Expression<FluentId>) -> bool {
    match expression {
        Expression::Linear(linear) => {
            let mut numbers = linear.terms.iter().map(|(_, c)| c).chain([&linear.constant]);
            numbers.all(|number| number.denominator() == 1)
        }
        Expression::Tree(crate::number::Operator::Divide, _) => false,
        Expression::Tree(_, parts) => parts.iter().all(is_whole),
    }
}
