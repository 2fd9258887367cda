//! Why a part of a domain cannot be read as graph.

use dsr::PatternError;
use pddl::model::Name;

use crate::disjuncts::MAX_ALTERNATIVES;
use crate::located::Located;

/// Why a condition or an effect cannot be read as graph.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[expect(missing_docs, reason = "the fields are the names that the variant is about")]
pub enum LinkErrorKind {
    /// The predicate cannot stand in the graph.
    #[error("`{name}` is no token of vocabulary `{vocabulary}`")]
    NotAToken { name: Name, vocabulary: Name },
    /// A type as a predicate: variables and nodes have their types already.
    #[error("types cannot be asked for here")]
    TypeCondition,
    /// The function cannot stand in the graph.
    #[error("`{name}` is no attribute of vocabulary `{vocabulary}`")]
    NotAnAttribute { name: Name, vocabulary: Name },
    /// The type is not one of nodes of the graph.
    #[error("`?{variable}`: `{name}` is no type of vocabulary `{vocabulary}`")]
    UnknownType { variable: Name, name: Name, vocabulary: Name },
    /// Values can be written, not asked for.
    #[error("`?{variable}` stands for a value; a condition is about nodes")]
    ValueVariable { variable: Name },
    /// A value stands where a node is meant.
    #[error("`{name}` is a value, not a node")]
    ValueTerm { name: Name },
    /// A pose has no equality.
    #[error("`{name}` is a pose; compare `distance` instead")]
    PoseComparison { name: Name },
    /// Initial poses are no attributes.
    #[error("`{name}` is a part of an initial pose; the graph has the whole pose as `rt`")]
    PosePart { name: Name },
    /// The graph compares an attribute with a number or with an attribute, a distance with a number.
    #[error(
        "this comparison is beyond the graph: it compares an attribute with a number or an attribute, or a \
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
    #[error("`{name}` is computed by the graph, nobody can write it")]
    Computed { name: Name },
    /// A function is given what it cannot hold.
    #[error("`{name}` cannot be given this value")]
    WrongValue { name: Name },
    /// What shall be seen must be said without looking at what is.
    #[error("this cannot be awaited: the result depends on the present value")]
    NotExpectable,
    /// The graph can never match it.
    #[error("never matches: {0}")]
    Pattern(#[from] PatternError),
}

/// A part of a schema that cannot be read as graph.
pub type LinkError = Located<LinkErrorKind>;
