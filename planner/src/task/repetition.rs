//! How operators satisfy comparisons in the relaxation: at once, or step by step.
//!
//! Problem: for a relaxation that supports only bits, one litre fills the tank. Idea: if an
//! operator always adds the same amount to a weighted sum of fluents, the amount that the sum lacks
//! in a state gives the number of repetitions. If it adds the value of other fluents (a rate),
//! their values in the state give the amount. Any other effect of an operator on a comparison
//! (assignments, scaling, products) may satisfy it at once. An operator's effects on one sum are
//! added up; conditional ones may increase the amount. Invariant: if a comparison becomes true on a
//! path from a state, then some operator of that path has a node that achieves it from that state
//! in finitely many repetitions, so relaxations stay safe.
//!
//! Source: Scala, Haslum, Thiébaux & Ramirez, "Subgoaling techniques for satisficing and optimal numeric
//! planning", JAIR 2020, §4; Hoffmann, "The Metric-FF planning system", JAIR 2003. Rates are ours.

use super::numeric::{Comparison, Numeric, NumericEffects, Update};
use super::{Literals, Operator};
use crate::ids::{FactId, FluentId};
use crate::number::{Change, Expression, Number, Relation};
use rustc_hash::FxHashMap;

/// How a node achieves a proposition.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Way {
    /// The proposition holds afterwards, as far as the relaxation knows.
    Once,
    /// Each repetition moves this comparison by this many of its units.
    Steps { comparison: u32, step: f64 },
    /// Each repetition moves this comparison by the value of an expression, which other operators
    /// may change.
    Rate { comparison: u32, step: Box<Expression<FluentId>> },
}

/// The ways of all effects of a graph, by their position among all effects.
#[derive(Clone, Debug, Default)]
pub(crate) struct Ways {
    /// Positions in `known`, plus 1; 0 is [`Way::Once`], and so is every effect beyond the end.
    of: Vec<u32>,
    known: Vec<Way>,
    /// By proposition: its comparison, if some node achieves it step by step.
    comparisons: FxHashMap<u32, u32>,
    /// By operator: the sums that it takes from, and the amounts.
    takings: FxHashMap<u32, Box<[Taking]>>,
}

impl Ways {
    pub(crate) fn is_empty(&self) -> bool {
        self.known.is_empty()
    }

    pub(crate) fn get(&self, effect: usize) -> &Way {
        match self.of.get(effect) {
            None | Some(0) => &Way::Once,
            Some(&position) => &self.known[position as usize - 1],
        }
    }

    pub(crate) fn set(&mut self, effect: usize, proposition: u32, way: Way) {
        if let Way::Steps { comparison, .. } | Way::Rate { comparison, .. } = way {
            self.comparisons.insert(proposition, comparison);
        } else {
            return;
        }
        if self.of.len() <= effect {
            self.of.resize(effect + 1, 0);
        }
        self.known.push(way);
        self.of[effect] = crate::ids::id32(self.known.len());
    }

    /// The comparison of a proposition that some node achieves step by step.
    pub(crate) fn comparison(&self, proposition: u32) -> Option<u32> {
        self.comparisons.get(&proposition).copied()
    }

    /// The sums that an operator takes from, and the amounts.
    pub(crate) fn takings(&self, operator: u32) -> &[Taking] {
        self.takings.get(&operator).map_or(&[], |takings| takings)
    }

    pub(crate) fn set_takings(&mut self, operator: u32, takings: Vec<Taking>) {
        if !takings.is_empty() {
            self.takings.insert(operator, takings.into());
        }
    }

    /// The part that depends on operators alone, so it holds for every graph of the same operators.
    pub(crate) fn without_effects(&self) -> Self {
        Self { takings: self.takings.clone(), ..Self::default() }
    }
}

/// The amount that an operator takes each time from a sum that some comparison bounds from below.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Taking {
    pub(crate) sum: u32,
    pub(crate) amount: f64,
    /// Whether the operator's own precondition bounds the sum.
    pub(crate) is_needed: bool,
}

/// How effects with one condition may change comparisons.
pub(crate) struct Influenced<'e> {
    pub(crate) condition: &'e Literals,
    /// The comparisons that may become true, and how.
    pub(crate) holds: Vec<(FactId, Way)>,
    /// The comparisons that may become false.
    pub(crate) fails: Vec<FactId>,
}

/// How effects with one condition change one comparison.
enum Move {
    /// They add this to the expression of the comparison.
    By(Expression<FluentId>),
    /// Any other change.
    Any { may_hold: bool, may_fail: bool },
}

impl Move {
    fn constant(&self) -> Option<Number> {
        match self {
            Self::By(expression) => expression.as_constant(),
            Self::Any { .. } => None,
        }
    }
}

impl Numeric {
    /// How an operator may change comparisons, grouped by the condition of the effects.
    pub(crate) fn influences<'e>(&self, effects: &'e NumericEffects) -> Vec<Influenced<'e>> {
        let mut groups: Vec<(Influenced<'e>, Vec<&Update>)> = Vec::new();
        for update in &effects.updates {
            match groups.iter_mut().find(|(group, _)| *group.condition == update.condition) {
                Some((_, updates)) => updates.push(update),
                None => {
                    let condition = &update.condition;
                    groups
                        .push((Influenced { condition, holds: Vec::new(), fails: Vec::new() }, vec![update]));
                }
            }
        }
        for &position in &effects.rechecked {
            let comparison = &self.comparisons[position as usize];
            let moves: Vec<Option<Move>> =
                groups.iter().map(|(_, updates)| self.moved(comparison, updates)).collect();
            for (i, (group, _)) in groups.iter_mut().enumerate() {
                let Some(own) = &moves[i] else { continue };
                let others =
                    || moves.iter().enumerate().filter(|(j, _)| *j != i).filter_map(|(_, m)| m.as_ref());
                let (way, fails) = self.way(position, own, others);
                group.holds.extend(way.map(|way| (comparison.fact, way)));
                if fails {
                    group.fails.push(comparison.fact);
                }
            }
        }
        groups.into_iter().map(|(group, _)| group).collect()
    }

    /// `None` if none of the updates changes the comparison.
    fn moved(&self, comparison: &Comparison, updates: &[&Update]) -> Option<Move> {
        let mut all: Option<Move> = None;
        for update in updates {
            let mut reads = false;
            comparison.expression.each_fluent(&mut |&f| reads |= f == update.fluent);
            if !reads {
                continue;
            }
            let influence = self.influence(update, comparison);
            let any = || Move::Any { may_hold: influence.may_hold, may_fail: influence.may_fail };
            let own = match (influence.step, shift(comparison, update)) {
                (Some(step), _) => Move::By(Expression::constant(step)),
                (None, Some(rate)) => Move::By(rate),
                (None, None) => any(),
            };
            all = Some(match (all, own) {
                (None, own) => own,
                (Some(Move::By(a)), Move::By(b)) => {
                    a.plus(b).map_or(Move::Any { may_hold: true, may_fail: true }, Move::By)
                }
                (Some(a), b) => {
                    let (a, b) = (a.may(comparison.relation), b.may(comparison.relation));
                    Move::Any { may_hold: a.0 || b.0, may_fail: a.1 || b.1 }
                }
            });
        }
        all
    }

    /// How a change achieves the comparison, and whether it may make it false.
    fn way<'m, I: Iterator<Item = &'m Move>>(
        &self,
        position: u32,
        own: &Move,
        others: impl Fn() -> I,
    ) -> (Option<Way>, bool) {
        let comparison = &self.comparisons[position as usize];
        let (may_hold, may_fail) = own.may(comparison.relation);
        let Move::By(expression) = own else { return (may_hold.then_some(Way::Once), may_fail) };
        let way = match (own.constant(), comparison.relation) {
            _ if !may_hold => None,
            (_, Relation::NonZero | Relation::Defined) => Some(Way::Once),
            // Another change may add just the amount that makes the sum equal.
            (Some(_), Relation::Zero) if others().next().is_some() => Some(Way::Once),
            (Some(step), _) => {
                let mut more = others().filter_map(Move::constant).filter(|n| n.sign() > 0);
                let whole = more.try_fold(step, Number::plus);
                let units = whole.and_then(|step| step.times(self.unit(comparison)));
                Some(units.map_or(Way::Once, |n| Way::Steps { comparison: position, step: n.to_f64() }))
            }
            (None, _) => Some(Way::Rate { comparison: position, step: Box::new(expression.clone()) }),
        };
        (way, may_fail)
    }

    /// How many repetitions of a way satisfy its comparison with `more` units to spare, if nothing
    /// else changes it; `None` if no number of repetitions does, whatever other operators do.
    pub(crate) fn repetitions(&self, way: &Way, more: f64, words: &[u64]) -> Option<f64> {
        let (comparison, step) = match way {
            Way::Once => return Some(1.0),
            Way::Steps { comparison, step } => (&self.comparisons[*comparison as usize], *step),
            Way::Rate { comparison, step } => {
                let comparison = &self.comparisons[*comparison as usize];
                let Ok(rate) = step.evaluate(&|&f| self.value(words, f)) else { return Some(1.0) };
                let rate = rate.to_f64() * self.unit(comparison).to_f64();
                // The rate may change, and then one more step may be enough.
                let value = self.measure(comparison, words).map(|value| value - more);
                return Some(times(comparison.relation, value, rate).unwrap_or(1.0));
            }
        };
        let value = self.measure(comparison, words).map(|value| value - more);
        match times(comparison.relation, value, step) {
            None if comparison.steady => None,
            // An assignment may reverse the sign, or define the value in the first place.
            None => (comparison.relation == Relation::Zero || value.is_none()).then_some(1.0),
            times => times,
        }
    }

    /// The sum that a comparison bounds from below, and the number 1 in the units of the
    /// comparison.
    pub(crate) fn sum_of(&self, comparison: u32) -> Option<(u32, f64)> {
        let comparison = &self.comparisons[comparison as usize];
        Some((comparison.sum?, self.unit(comparison).to_f64()))
    }

    /// The sums that an operator takes from, and the amounts. `of` maps facts to comparisons.
    pub(crate) fn takings(&self, operator: &Operator, of: &FxHashMap<FactId, u32>) -> Vec<Taking> {
        let Some(effects) = &operator.numeric else { return Vec::new() };
        let needed: Vec<u32> =
            operator.precondition.positive.iter().filter_map(|f| of.get(f).copied()).collect();
        let needed: Vec<u32> = needed.into_iter().filter_map(|c| self.comparisons[c as usize].sum).collect();
        let always: Vec<&Update> = effects.updates.iter().filter(|u| u.condition.is_empty()).collect();
        let (mut found, mut seen) = (Vec::new(), Vec::new());
        for &position in &effects.rechecked {
            let comparison = &self.comparisons[position as usize];
            let Some(sum) = comparison.sum.filter(|sum| !seen.contains(sum)) else { continue };
            seen.push(sum);
            let step = self.moved(comparison, &always).and_then(|own| own.constant());
            if let Some(step) = step.filter(|step| step.sign() < 0) {
                let is_needed = needed.contains(&sum);
                found.push(Taking { sum, amount: -step.to_f64(), is_needed });
            }
        }
        found
    }

    /// The amount that a comparison lacks, in its units and with a sign; `None` if its value is
    /// undefined, or if other effects than constant additions change it.
    pub(crate) fn lack(&self, comparison: u32, words: &[u64]) -> Option<f64> {
        let comparison = &self.comparisons[comparison as usize];
        let value = self.measure(comparison, words).filter(|_| comparison.steady)?;
        match comparison.relation {
            Relation::Positive | Relation::NonNegative => Some((-value).max(0.0)),
            Relation::Zero => Some(-value),
            Relation::NonZero | Relation::Defined => None,
        }
    }
}

impl Move {
    /// Whether a comparison of this relation may become true, and whether it may become false.
    fn may(&self, relation: Relation) -> (bool, bool) {
        match self {
            Self::Any { may_hold, may_fail } => (*may_hold, *may_fail),
            Self::By(_) => match (self.constant(), relation) {
                (Some(step), _) if step.is_zero() => (false, false),
                (Some(step), Relation::Positive | Relation::NonNegative) => {
                    (step.sign() > 0, step.sign() < 0)
                }
                _ => (true, true),
            },
        }
    }
}

/// The amount that an update adds to the expression of a comparison, if that is linear in other
/// fluents.
fn shift(comparison: &Comparison, update: &Update) -> Option<Expression<FluentId>> {
    let (Expression::Linear(compared), Some(value @ Expression::Linear(_))) =
        (&comparison.expression, &update.value)
    else {
        return None;
    };
    if update.change != Change::Shift || comparison.relation == Relation::Defined {
        return None;
    }
    let coefficient = compared.terms.iter().find(|(f, _)| *f == update.fluent).map(|(_, c)| *c)?;
    value.clone().times(Expression::constant(coefficient)).ok()
}

/// The number of steps until the relation holds.
fn times(relation: Relation, value: Option<f64>, step: f64) -> Option<f64> {
    let value = value?;
    match relation {
        Relation::Positive if value > 0.0 => Some(0.0),
        Relation::Positive => (step > 0.0).then(|| (-value / step).floor() + 1.0),
        Relation::NonNegative if value >= 0.0 => Some(0.0),
        Relation::NonNegative => (step > 0.0).then(|| (-value / step).ceil()),
        Relation::Zero if value == 0.0 => Some(0.0),
        Relation::Zero => (step * value < 0.0).then(|| (-value / step).ceil()),
        Relation::NonZero | Relation::Defined => Some(1.0),
    }
}

#[cfg(test)]
mod tests {
    use super::{Relation, times};

    #[test]
    fn repetitions_are_counted_up_to_the_bound() {
        assert_eq!(times(Relation::NonNegative, Some(-10.0), 3.0), Some(4.0));
        assert_eq!(times(Relation::NonNegative, Some(-9.0), 3.0), Some(3.0));
        assert_eq!(times(Relation::Positive, Some(-9.0), 3.0), Some(4.0));
        assert_eq!(times(Relation::Positive, Some(0.0), 3.0), Some(1.0));
        assert_eq!(times(Relation::Positive, Some(0.5), 3.0), Some(0.0));
        assert_eq!(times(Relation::Positive, Some(0.0), -3.0), None);
        assert_eq!(times(Relation::Zero, Some(7.0), -2.0), Some(4.0));
        assert_eq!(times(Relation::Zero, Some(7.0), 2.0), None);
        assert_eq!(times(Relation::Zero, None, 2.0), None);
    }
}
