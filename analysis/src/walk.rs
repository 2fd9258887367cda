//! Conditions, effects and expressions, part by part, from left to right.
//!
//! Callers match on [`Part`] instead of the model's forms, so that a new form is added here only.

use pddl::model::{
    Application, AssignOperator, AssignedValue, Atom, Condition, ConditionKind, Constraint, ConstraintKind,
    Constraints, Effect, EffectKind, Expression, ExpressionKind, Invariant, PredicateId, Preference,
    SubtaskHead, Term, VariableId,
};

/// Whether something must be true or must be false for the whole to hold.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Polarity {
    /// Under an even number of negations.
    Positive,
    /// Under an odd number.
    Negative,
}

impl Polarity {
    /// The other one.
    pub fn opposite(self) -> Self {
        match self {
            Self::Positive => Self::Negative,
            Self::Negative => Self::Positive,
        }
    }
}

/// A part of a body.
#[derive(Clone, Copy, Debug)]
pub enum Part<'a> {
    /// A condition asks for an atom.
    Needs(&'a Atom, Polarity),
    /// An effect makes it true.
    Adds(&'a Atom),
    /// An effect makes it false.
    Deletes(&'a Atom),
    /// An axiom derives a predicate.
    Derives(PredicateId),
    /// A fluent's value is asked for.
    Reads(&'a Application),
    /// An effect changes a fluent.
    Writes(AssignOperator, &'a Application),
    /// A quantifier binds slots.
    Binds(&'a [VariableId]),
    /// A term that stands anywhere else: beside `=`, as a value, as an argument of a task or a skill.
    Term(Term),
    /// A network has a subtask.
    Subtask(SubtaskHead),
}

impl Part<'_> {
    /// The terms in it.
    pub fn terms(&self) -> &[Term] {
        match self {
            Self::Needs(atom, _) | Self::Adds(atom) | Self::Deletes(atom) => &atom.arguments,
            Self::Reads(application) | Self::Writes(_, application) => &application.arguments,
            Self::Term(term) => std::slice::from_ref(term),
            Self::Binds(_) | Self::Derives(_) | Self::Subtask(_) => &[],
        }
    }
}

/// The parts of a condition.
pub fn condition<'a>(of: &'a Condition, polarity: Polarity, f: &mut dyn FnMut(Part<'a>)) {
    match &of.kind {
        ConditionKind::And(parts) | ConditionKind::Or(parts) => {
            parts.iter().for_each(|part| condition(part, polarity, f));
        }
        ConditionKind::Not(inner) => condition(inner, polarity.opposite(), f),
        ConditionKind::Imply(left, right) => {
            condition(left, polarity.opposite(), f);
            condition(right, polarity, f);
        }
        ConditionKind::Exists(bound, inner) | ConditionKind::Forall(bound, inner) => {
            f(Part::Binds(bound));
            condition(inner, polarity, f);
        }
        ConditionKind::Atom(atom) => f(Part::Needs(atom, polarity)),
        ConditionKind::HasType(term, _) => f(Part::Term(*term)),
        ConditionKind::Same(left, right) => {
            f(Part::Term(*left));
            f(Part::Term(*right));
        }
        ConditionKind::Compare(_, left, right) => {
            expression(left, f);
            expression(right, f);
        }
        ConditionKind::FluentIs(application, value) => {
            f(Part::Reads(application));
            f(Part::Term(*value));
        }
    }
}

/// The parts of a preference; `what` is the condition in its body.
pub fn preference<'a, T>(of: &'a Preference<T>, what: &'a Condition, f: &mut dyn FnMut(Part<'a>)) {
    if !of.forall.is_empty() {
        f(Part::Binds(&of.forall));
    }
    condition(what, Polarity::Positive, f);
}

/// The parts of trajectory constraints. Whether a condition below an operator must be true or false depends on the
/// operator (`sometime-before` asks for neither alone), so that polarity counts plain negations only.
pub fn constraints<'a>(of: &'a Constraints, f: &mut dyn FnMut(Part<'a>)) {
    of.hard.iter().for_each(|c| constraint(c, Polarity::Positive, f));
    for preference in &of.preferences {
        if !preference.forall.is_empty() {
            f(Part::Binds(&preference.forall));
        }
        constraint(&preference.body, Polarity::Positive, f);
    }
}

/// The parts of an invariant; its parameters are not bound by a part.
pub fn invariant<'a>(of: &'a Invariant, f: &mut dyn FnMut(Part<'a>)) {
    constraint(&of.constraint, Polarity::Positive, f);
}

fn constraint<'a>(of: &'a Constraint, polarity: Polarity, f: &mut dyn FnMut(Part<'a>)) {
    match &of.kind {
        ConstraintKind::Holds(inner) => condition(inner, polarity, f),
        ConstraintKind::And(parts) | ConstraintKind::Or(parts) => {
            parts.iter().for_each(|part| constraint(part, polarity, f));
        }
        ConstraintKind::Not(inner) => constraint(inner, polarity.opposite(), f),
        ConstraintKind::Imply(left, right) => {
            constraint(left, polarity.opposite(), f);
            constraint(right, polarity, f);
        }
        ConstraintKind::Exists(bound, inner) | ConstraintKind::Forall(bound, inner) => {
            f(Part::Binds(bound));
            constraint(inner, polarity, f);
        }
        ConstraintKind::SometimeAfter(left, right)
        | ConstraintKind::SometimeBefore(left, right)
        | ConstraintKind::AlwaysWithin(_, left, right) => {
            constraint(left, polarity, f);
            constraint(right, polarity, f);
        }
        ConstraintKind::AtEnd(inner)
        | ConstraintKind::Always(inner)
        | ConstraintKind::Sometime(inner)
        | ConstraintKind::Within(_, inner)
        | ConstraintKind::AtMostOnce(inner)
        | ConstraintKind::HoldDuring(_, _, inner)
        | ConstraintKind::HoldAfter(_, inner) => constraint(inner, polarity, f),
    }
}

/// The parts of an effect.
pub fn effect<'a>(of: &'a Effect, f: &mut dyn FnMut(Part<'a>)) {
    match &of.kind {
        EffectKind::And(parts) => parts.iter().for_each(|part| effect(part, f)),
        EffectKind::Add(atom) => f(Part::Adds(atom)),
        EffectKind::Delete(atom) => f(Part::Deletes(atom)),
        EffectKind::Assign(operator, application, value) => {
            f(Part::Writes(*operator, application));
            match value {
                AssignedValue::Number(value) => expression(value, f),
                AssignedValue::Object(value) => f(Part::Term(*value)),
                AssignedValue::Undefined => {}
            }
        }
        EffectKind::Forall(bound, inner) => {
            f(Part::Binds(bound));
            effect(inner, f);
        }
        EffectKind::When(when, inner) => {
            condition(when, Polarity::Positive, f);
            effect(inner, f);
        }
    }
}

/// The parts of an expression.
pub fn expression<'a>(of: &'a Expression, f: &mut dyn FnMut(Part<'a>)) {
    match &of.kind {
        ExpressionKind::Fluent(application) => f(Part::Reads(application)),
        ExpressionKind::Arithmetic(_, operands) => operands.iter().for_each(|operand| expression(operand, f)),
        ExpressionKind::Number(_)
        | ExpressionKind::Duration
        | ExpressionKind::TotalTime
        | ExpressionKind::IsViolated(_) => {}
    }
}
