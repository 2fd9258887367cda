//! The smallest parts of a condition that keep it from holding.

use super::fault::NumericFault;
use crate::cause::Cause;
use crate::number::Number;
use crate::value::GroundAtom;
use pddl::Span;
use pddl::model::{Comparison, GroundApplication, Name, ObjectId};

/// A smallest unsatisfied part of a condition.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Unsatisfied {
    /// An atom should hold.
    Missing {
        /// The atom.
        atom: GroundAtom,
        /// The happening that deleted it last; `None` if it never held.
        deleted_by: Option<Cause>,
        /// Whether an axiom would have to derive it.
        derived: bool,
        /// The unsatisfied parts of the axiom that comes closest to deriving it; spans are in the domain.
        because: Vec<Unsatisfied>,
        /// The place of the condition.
        span: Span,
    },
    /// An atom should not hold.
    Present {
        /// The atom.
        atom: GroundAtom,
        /// The happening that added it last; `None` if it held initially, or an axiom derives it.
        added_by: Option<Cause>,
        /// Whether an axiom derives it.
        derived: bool,
        /// The parts that would have to change for the axioms not to derive it; spans are in the domain.
        because: Vec<Unsatisfied>,
        /// The place of the condition.
        span: Span,
    },
    /// An object should be, or should not be, of a type.
    Type {
        /// The object.
        object: ObjectId,
        /// The type; of several, one is enough.
        types: pddl::model::TypeSet,
        /// Whether it should be of that type.
        wanted: bool,
        /// The place of the condition.
        span: Span,
    },
    /// Two objects should be the same.
    Different {
        /// The first.
        left: ObjectId,
        /// The second.
        right: ObjectId,
        /// The place of the condition.
        span: Span,
    },
    /// Two objects should be different.
    Same {
        /// The object that both are.
        object: ObjectId,
        /// The place of the condition.
        span: Span,
    },
    /// A comparison fails, or cannot be made.
    Comparison {
        /// The comparison.
        comparison: Comparison,
        /// Whether it should be true.
        wanted: bool,
        /// Its left side.
        left: Operand,
        /// Its right side.
        right: Operand,
        /// The place of the condition.
        span: Span,
    },
    /// An object fluent has the wrong value.
    Fluent {
        /// The fluent.
        fluent: GroundApplication,
        /// The object that it should be, or should not be.
        value: ObjectId,
        /// Whether it should be.
        wanted: bool,
        /// Its value; `None` is undefined.
        actual: Option<ObjectId>,
        /// The place of the condition.
        span: Span,
    },
    /// None of several alternatives holds.
    Alternatives {
        /// The unsatisfied parts of each. `(or)` has no alternative.
        branches: Vec<Vec<Unsatisfied>>,
        /// The disjunction.
        span: Span,
    },
    /// A universal condition fails for these objects.
    Counterexample {
        /// The quantified variables' values.
        binding: Vec<(Name, ObjectId)>,
        /// The unsatisfied parts for these objects.
        parts: Vec<Unsatisfied>,
        /// The quantifier.
        span: Span,
    },
    /// An existential condition has no witness.
    NoWitness {
        /// The objects with the fewest unsatisfied parts that a bounded search found; `None` if the types have no object.
        closest: Option<Near>,
        /// The quantifier.
        span: Span,
    },
}

impl Unsatisfied {
    /// The place of the condition.
    pub fn span(&self) -> Span {
        match self {
            Self::Missing { span, .. }
            | Self::Present { span, .. }
            | Self::Different { span, .. }
            | Self::Type { span, .. }
            | Self::Same { span, .. }
            | Self::Comparison { span, .. }
            | Self::Fluent { span, .. }
            | Self::Alternatives { span, .. }
            | Self::Counterexample { span, .. }
            | Self::NoWitness { span, .. } => *span,
        }
    }

    /// Visits these parts and those nested in them.
    pub(crate) fn each<'p>(parts: &'p [Self], visit: &mut dyn FnMut(&'p Self)) {
        for part in parts {
            visit(part);
            match part {
                Self::Alternatives { branches, .. } => {
                    branches.iter().for_each(|branch| Self::each(branch, visit));
                }
                Self::Counterexample { parts, .. } => Self::each(parts, visit),
                Self::NoWitness { closest: Some(near), .. } => Self::each(&near.parts, visit),
                _ => {}
            }
        }
    }
}

/// Objects that almost satisfy a condition.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Near {
    /// The quantified variables' values.
    pub binding: Vec<(Name, ObjectId)>,
    /// Their unsatisfied parts.
    pub parts: Vec<Unsatisfied>,
}

/// A side of a comparison.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Operand {
    /// Its value, or the reason why it has no value.
    pub value: Result<Number, NumericFault>,
    /// The fluents in it with their values.
    pub fluents: Vec<(GroundApplication, Option<Number>)>,
    /// Its place.
    pub span: Span,
}
