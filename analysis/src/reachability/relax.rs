//! Conditions as alternatives of atoms to join and checks to make.
//!
//! Idea: disjunctions are multiplied out while the number of alternatives stays small. A larger disjunction and a
//! universal condition are kept whole, as a check that is evaluated under a complete binding. Invariant: if a state
//! that the relaxation covers satisfies the condition, then some alternative holds in the relaxation. So a negated atom
//! counts as true if it may be deleted, and a comparison if its numbers may change far enough.

use std::rc::Rc;

use pddl::model::{Condition, ConditionKind, Expression, ExpressionKind, Idx, Term};

use crate::intervals::{Expected, Hulls, Interval};
use crate::walk::Polarity;

use super::database::RelationId;
use super::rule::{Check, Pattern};

/// The most alternatives that are multiplied out.
const ALTERNATIVES: usize = 24;

/// Atoms and checks that must all hold.
#[derive(Clone, Debug, Default)]
pub(crate) struct Conjunction {
    pub(crate) body: Vec<Pattern>,
    pub(crate) checks: Vec<Check>,
}

impl Conjunction {
    fn of(pattern: Pattern) -> Self {
        Self { body: vec![pattern], checks: Vec::new() }
    }

    fn check(check: Check) -> Self {
        Self { body: Vec::new(), checks: vec![check] }
    }

    pub(crate) fn and(&self, other: &Self) -> Self {
        let mut both = self.clone();
        both.body.extend(other.body.iter().cloned());
        both.checks.extend(other.checks.iter().cloned());
        both
    }
}

/// What is known of a relation before the first join.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Knowledge {
    /// An atom holds only if it is an initial fact or can be derived. It may be deleted.
    Deletable,
    /// An atom holds only if it is an initial fact or can be derived. It is never deleted.
    Kept,
    /// Any atom may hold initially.
    Open,
}

/// Converts conditions to alternatives.
pub(crate) struct Relaxer<'a> {
    pub(crate) predicates: &'a [RelationId],
    pub(crate) fluents: &'a [RelationId],
    pub(crate) known: &'a [Knowledge],
    pub(crate) hulls: &'a Hulls,
}

impl Relaxer<'_> {
    /// The alternatives of a condition; empty if it can never hold.
    pub(crate) fn relax(&self, condition: &Condition, polarity: Polarity) -> Vec<Conjunction> {
        let span = condition.span;
        match (&condition.kind, polarity) {
            (ConditionKind::And(parts), Polarity::Positive)
            | (ConditionKind::Or(parts), Polarity::Negative) => {
                let parts = parts.iter().map(|p| (p, self.relax(p, polarity)));
                Self::all(parts.collect(), polarity)
            }
            (ConditionKind::Or(parts), Polarity::Positive)
            | (ConditionKind::And(parts), Polarity::Negative) => {
                let all: Vec<_> = parts.iter().flat_map(|p| self.relax(p, polarity)).collect();
                Self::few(all, condition, polarity)
            }
            (ConditionKind::Imply(left, right), Polarity::Positive) => {
                let mut all = self.relax(left, Polarity::Negative);
                all.extend(self.relax(right, Polarity::Positive));
                Self::few(all, condition, polarity)
            }
            (ConditionKind::Imply(left, right), Polarity::Negative) => {
                let left = (&**left, self.relax(left, Polarity::Positive));
                let right_ = self.relax(right, Polarity::Negative);
                let mut rows = Vec::new();
                for a in &left.1 {
                    rows.extend(right_.iter().map(|b| a.and(b)));
                }
                Self::few(rows, condition, polarity)
            }
            (ConditionKind::Not(inner), _) => self.relax(inner, polarity.opposite()),
            (ConditionKind::Exists(_, inner), Polarity::Positive)
            | (ConditionKind::Forall(_, inner), Polarity::Negative) => self.relax(inner, polarity),
            (ConditionKind::Exists(..), Polarity::Negative)
            | (ConditionKind::Forall(..), Polarity::Positive) => {
                vec![Conjunction::check(Check::Residual(polarity, Rc::new(condition.clone())))]
            }
            (ConditionKind::Atom(atom), _) => {
                let relation = self.predicates[atom.predicate.index()];
                self.literal(Pattern { relation, arguments: atom.arguments.clone(), span }, polarity)
            }
            (ConditionKind::FluentIs(application, value), _) => {
                let relation = self.fluents[application.function.index()];
                let arguments = application.arguments.iter().copied().chain([*value]).collect();
                self.literal(Pattern { relation, arguments, span }, polarity)
            }
            // Types are not checked here, so the condition may hold.
            (ConditionKind::HasType(..), _) => vec![Conjunction::default()],
            (ConditionKind::Same(a, b), Polarity::Positive) => vec![Conjunction::check(Check::Same(*a, *b))],
            (ConditionKind::Same(a, b), Polarity::Negative) => {
                vec![Conjunction::check(Check::Different(*a, *b))]
            }
            (ConditionKind::Compare(comparison, left, right), _) => {
                if self.is_anything(left) || self.is_anything(right) {
                    return vec![Conjunction::default()];
                }
                let sides = Rc::new(((**left).clone(), (**right).clone()));
                vec![Conjunction::check(Check::Compare(polarity, *comparison, sides, span))]
            }
        }
    }

    /// The alternatives of a conjunction.
    pub(crate) fn conjoin(&self, conditions: &[&Condition]) -> Vec<Conjunction> {
        let parts = conditions.iter().map(|c| (*c, self.relax(c, Polarity::Positive)));
        Self::all(parts.collect(), Polarity::Positive)
    }

    fn literal(&self, pattern: Pattern, polarity: Polarity) -> Vec<Conjunction> {
        match (self.known[pattern.relation.0 as usize], polarity) {
            (Knowledge::Open, _) | (Knowledge::Deletable, Polarity::Negative) => vec![Conjunction::default()],
            (_, Polarity::Positive) => vec![Conjunction::of(pattern)],
            (Knowledge::Kept, Polarity::Negative) => vec![Conjunction::check(Check::Absent(pattern))],
        }
    }

    /// Whether the expression may have any value. A comparison with it cannot be refuted.
    fn is_anything(&self, expression: &Expression) -> bool {
        let mut known = true;
        expression.each(&mut |part| {
            known &= match &part.kind {
                ExpressionKind::Fluent(application) => {
                    self.hulls.of(application.function) != Some(Interval::ALL)
                }
                ExpressionKind::Number(_) | ExpressionKind::Arithmetic(..) => true,
                _ => false,
            };
        });
        !known
    }

    fn all(mut parts: Vec<(&Condition, Vec<Conjunction>)>, polarity: Polarity) -> Vec<Conjunction> {
        let mut rows = vec![Conjunction::default()];
        // Conditions with the fewest alternatives first: one alternative multiplies nothing, and none ends the product.
        parts.sort_by_key(|(_, alternatives)| alternatives.len());
        for (condition, alternatives) in parts {
            if rows.len() * alternatives.len() > ALTERNATIVES {
                let check = Check::Residual(polarity, Rc::new(condition.clone()));
                rows.iter_mut().for_each(|r| r.checks.push(check.clone()));
            } else {
                rows = rows.iter().flat_map(|r| alternatives.iter().map(|a| r.and(a))).collect();
            }
        }
        rows
    }

    fn few(rows: Vec<Conjunction>, condition: &Condition, polarity: Polarity) -> Vec<Conjunction> {
        if let Some(true_) = rows.iter().position(|r| r.body.is_empty() && r.checks.is_empty()) {
            return vec![rows[true_].clone()];
        }
        if rows.len() > ALTERNATIVES {
            return vec![Conjunction::check(Check::Residual(polarity, Rc::new(condition.clone())))];
        }
        rows
    }
}

/// The result that a comparison needs under a polarity.
pub(crate) fn expected(polarity: Polarity) -> Expected {
    match polarity {
        Polarity::Positive => Expected::Holds,
        Polarity::Negative => Expected::Fails,
    }
}

/// The slots of terms.
pub(crate) fn slots_of<'t>(terms: impl IntoIterator<Item = &'t Term>) -> impl Iterator<Item = usize> {
    terms.into_iter().filter_map(|t| match t {
        Term::Variable(v) => Some(v.index()),
        Term::Object(_) => None,
    })
}

/// The slots that a condition reads and does not bind.
pub(crate) fn free_slots(condition: &Condition) -> Vec<usize> {
    use crate::walk::Part;
    let (mut read, mut bound) = (Vec::new(), Vec::new());
    crate::walk::condition(condition, Polarity::Positive, &mut |part| match part {
        Part::Binds(variables) => bound.extend(variables.iter().map(|v| v.index())),
        part => read.extend(slots_of(part.terms())),
    });
    // Every variable of a schema has its own slot, so a slot that is bound in one place is free in no other.
    read.retain(|slot| !bound.contains(slot));
    read.sort_unstable();
    read.dedup();
    read
}
