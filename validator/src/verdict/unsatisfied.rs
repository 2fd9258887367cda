//! The smallest parts of a condition that keep it from holding.

use super::fault::NumericFault;
use crate::cause::Cause;
use crate::number::Number;
use crate::value::GroundAtom;
use pddl::Span;
use pddl::model::{Comparison, GroundApplication, Name, ObjectId};

/// One smallest unsatisfied part of a condition.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Unsatisfied {
    /// An atom should hold.
    Missing {
        /// Which one.
        atom: GroundAtom,
        /// What deleted it last; `None` if it never held.
        deleted_by: Option<Cause>,
        /// Whether an axiom would have to derive it.
        derived: bool,
        /// What the axiom lacks that is nearest to deriving it; spans are of the domain.
        because: Vec<Unsatisfied>,
        /// Where it is asked for.
        span: Span,
    },
    /// An atom should not hold.
    Present {
        /// Which one.
        atom: GroundAtom,
        /// What added it last; `None` if it held from the beginning, or follows by an axiom.
        added_by: Option<Cause>,
        /// Whether an axiom derives it.
        derived: bool,
        /// What would have to be otherwise for it not to follow; spans are of the domain.
        because: Vec<Unsatisfied>,
        /// Where it is forbidden.
        span: Span,
    },
    /// An object should be of a type, or should not.
    Type {
        /// The object.
        object: ObjectId,
        /// The type, or several of which one is enough.
        types: pddl::model::TypeSet,
        /// Whether it should be.
        wanted: bool,
        /// Where that is asked for.
        span: Span,
    },
    /// Two objects should be the same.
    Different {
        /// One.
        left: ObjectId,
        /// The other.
        right: ObjectId,
        /// Where that is asked for.
        span: Span,
    },
    /// Two objects should be different.
    Same {
        /// The object that both are.
        object: ObjectId,
        /// Where that is forbidden.
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
        /// Where it stands.
        span: Span,
    },
    /// An object fluent has the wrong value.
    Fluent {
        /// Which one.
        fluent: GroundApplication,
        /// The object that it should be, or should not be.
        value: ObjectId,
        /// Whether it should.
        wanted: bool,
        /// What it is; `None` is undefined.
        actual: Option<ObjectId>,
        /// Where it stands.
        span: Span,
    },
    /// None of several alternatives holds.
    Alternatives {
        /// What each lacks. No alternative at all is `(or)`.
        branches: Vec<Vec<Unsatisfied>>,
        /// The disjunction.
        span: Span,
    },
    /// Something should be so for all objects, and is not for these.
    Counterexample {
        /// The quantified variables' values.
        binding: Vec<(Name, ObjectId)>,
        /// What is wrong with them.
        parts: Vec<Unsatisfied>,
        /// The quantifier.
        span: Span,
    },
    /// Something should be so for some objects, and is for none.
    NoWitness {
        /// The objects that lack least, as far as a bounded search shows; `None` if there are no objects.
        closest: Option<Near>,
        /// The quantifier.
        span: Span,
    },
}

impl Unsatisfied {
    /// Where it stands.
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
    /// What they lack.
    pub parts: Vec<Unsatisfied>,
}

/// A side of a comparison.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Operand {
    /// Its value, or why it has none.
    pub value: Result<Number, NumericFault>,
    /// The fluents in it with their values.
    pub fluents: Vec<(GroundApplication, Option<Number>)>,
    /// Where it stands.
    pub span: Span,
}
