//! Effects.

use super::{Application, Atom, Condition, Expression, Term, VariableId};
use crate::Span;

/// How a numeric fluent changes.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum AssignOperator {
    /// `assign`
    Assign,
    /// `increase`
    Increase,
    /// `decrease`
    Decrease,
    /// `scale-up`
    ScaleUp,
    /// `scale-down`
    ScaleDown,
}

/// The new value of a fluent.
#[derive(Clone, Debug)]
pub enum AssignedValue {
    /// A number, by any operator.
    Number(Expression),
    /// An object, by `assign` alone.
    Object(Term),
    /// `undefined`, by `assign` alone (PDDL 3.1): the fluent loses its value.
    Undefined,
}

/// An effect with its place.
#[derive(Clone, Debug)]
pub struct Effect {
    /// What it does.
    pub kind: EffectKind,
    /// Where it stands.
    pub span: Span,
}

/// The forms of an effect.
#[derive(Clone, Debug)]
pub enum EffectKind {
    /// All of them; an empty list changes nothing.
    And(Vec<Effect>),
    /// The atom becomes true.
    Add(Atom),
    /// The atom becomes false (an add of the same atom at the same time wins).
    Delete(Atom),
    /// A fluent changes.
    Assign(AssignOperator, Application, AssignedValue),
    /// For every binding of these slots.
    Forall(Vec<VariableId>, Box<Effect>),
    /// If the condition holds before.
    When(Condition, Box<Effect>),
}

impl Effect {
    /// The effect that changes nothing.
    pub fn nothing(span: Span) -> Self {
        Self { kind: EffectKind::And(Vec::new()), span }
    }

    /// The effects directly inside it, in order.
    pub fn parts(&self) -> &[Self] {
        match &self.kind {
            EffectKind::And(parts) => parts,
            EffectKind::Forall(_, part) | EffectKind::When(_, part) => std::slice::from_ref(part),
            EffectKind::Add(_) | EffectKind::Delete(_) | EffectKind::Assign(..) => &[],
        }
    }

    /// Visits it and every effect in it.
    pub fn each<'e>(&'e self, visit: &mut impl FnMut(&'e Effect)) {
        visit(self);
        self.parts().iter().for_each(|part| part.each(visit));
    }
}
