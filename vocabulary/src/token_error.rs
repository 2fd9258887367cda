//! Why a domain cannot become the vocabulary of a graph.

use dsr::VocabularyError;
use pddl::model::Name;

use crate::located::Located;

/// Why a declaration does not fit the graph.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[expect(missing_docs, reason = "the fields are the names that the variant is about")]
pub enum TokenErrorKind {
    /// Node types form a tree.
    #[error("type `{name}` has several parents; the graph's types have one each")]
    SeveralParents { name: Name },
    /// The graph's own types are children of `object` and have no subtypes.
    #[error(
        "`{name}` is below `{below}`; `agent` and `resource` are children of `object` and have no subtypes"
    )]
    BuiltInType { name: Name, below: Name },
    /// Only `text`, `flag` and `pose` are kinds of values.
    #[error("`{name}` is not a kind of value; the kinds are `text`, `flag` and `pose`")]
    UnknownValueType { name: Name },
    /// A node has one type.
    #[error("constant `{name}` has several types; a node has one")]
    SeveralTypes { name: Name },
    /// Only the truth values have names.
    #[error("constant `{name}` cannot be a value; only `true` and `false` of type `flag` can")]
    ValueConstant { name: Name },
    /// An edge has two ends.
    #[error("predicate `{name}` has {arity} arguments; an edge of the graph has two ends")]
    NotBinary { name: Name, arity: usize },
    /// Agents write tokens; no agent writes a derived predicate.
    #[error("predicate `{name}` is derived; agents write the tokens of a vocabulary")]
    Derived { name: Name },
    /// Edges are between nodes.
    #[error("`{name}` cannot be about a value (`?{variable}`); tokens are about nodes")]
    ValueArgument { name: Name, variable: Name },
    /// An attribute belongs to a node or an edge.
    #[error("function `{name}` has {arity} arguments; an attribute belongs to a node or to a pair of nodes")]
    FunctionArity { name: Name, arity: usize },
    /// An attribute belongs to one type of node.
    #[error("function `{name}`: `?{variable}` has several types; an attribute's argument has one")]
    FunctionArgument { name: Name, variable: Name },
    /// An attribute has one kind.
    #[error("function `{name}` has values of several types; an attribute has one kind")]
    FunctionKind { name: Name },
    /// Poses are kept in one tree.
    #[error("function `{name}` cannot be a pose; the graph keeps poses in one binary function `rt`")]
    PoseFunction { name: Name },
    /// These names are the graph's.
    #[error("function `{name}` must be binary, between frames, and a {expected}")]
    ReservedFunction { name: Name, expected: &'static str },
    /// A name means one thing.
    #[error("`{name}` is a predicate and a function; a label has one meaning")]
    TwoMeanings { name: Name },
    /// `:writes` names an agent.
    #[error("`{name}` may not write: it is not a constant of type `agent`")]
    NotAnAgent { name: Name },
    /// The graph computes it, so that no agent can write it.
    #[error("no agent can write `{name}`: the graph computes it")]
    Computed { name: Name },
    /// The graph refuses it.
    #[error(transparent)]
    Vocabulary(#[from] VocabularyError),
}

/// A declaration that does not fit the graph.
pub type TokenError = Located<TokenErrorKind>;
