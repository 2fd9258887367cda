//! Why a condition or an effect cannot be compiled.

use dsr::PatternError;
use pddl::model::Name;

use crate::disjuncts::MAX_ALTERNATIVES;
use crate::located::Located;

/// Why a condition or an effect cannot be compiled.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[expect(missing_docs, reason = "the fields are the names that the variant is about")]
pub enum LinkErrorKind {
    /// The vocabulary does not declare the predicate.
    #[error("`{name}` is not a token of vocabulary `{vocabulary}`")]
    NotAToken { name: Name, vocabulary: Name },
    /// A type is used as a predicate; variables and nodes have their types already.
    #[error("a condition cannot test the type of an object here")]
    TypeCondition,
    /// The vocabulary does not declare the function.
    #[error("`{name}` is not an attribute of vocabulary `{vocabulary}`")]
    NotAnAttribute { name: Name, vocabulary: Name },
    /// The vocabulary does not declare the type.
    #[error("`?{variable}`: `{name}` is not a type of vocabulary `{vocabulary}`")]
    UnknownType { variable: Name, name: Name, vocabulary: Name },
    /// A skill's result can be written, but not asked for.
    #[error("`?{variable}` stands for a value; a condition is about nodes")]
    ValueVariable { variable: Name },
    /// A value is given where a node is required.
    #[error("`{name}` is a value, not a node")]
    ValueTerm { name: Name },
    /// A pose has no equality.
    #[error("`{name}` is a pose; compare `distance` instead")]
    PoseComparison { name: Name },
    /// A number of an initial pose is not an attribute.
    #[error("`{name}` is a part of an initial pose; the graph has the whole pose as `rt`")]
    PosePart { name: Name },
    /// The graph compares an attribute with a number or with an attribute, a distance with a number.
    #[error(
        "the graph cannot evaluate this comparison: it compares an attribute with a number or an attribute, or a \
             distance with a number"
    )]
    Comparison,
    /// `?duration`, `total-time` and divisions by zero have no value here.
    #[error("this has no value here")]
    NoValue,
    /// Too many disjunctions.
    #[error("more than {MAX_ALTERNATIVES} alternatives")]
    TooManyAlternatives,
    /// The graph computes it.
    #[error("no agent can write `{name}`: the graph computes it")]
    Computed { name: Name },
    /// The function cannot have this value.
    #[error("`{name}` cannot be given this value")]
    WrongValue { name: Name },
    /// An expectation may not depend on the present value.
    #[error("this cannot be awaited: the result depends on the present value")]
    NotExpectable,
    /// The graph can never match it.
    #[error("never matches: {0}")]
    Pattern(#[from] PatternError),
}

/// A part of a schema that cannot be compiled, with its place.
pub type LinkError = Located<LinkErrorKind>;
