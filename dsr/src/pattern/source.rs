//! A pattern as it was written: plain data, without a vocabulary.
//!
//! The same types hold the compiled form, with slots in place of terms.

use std::sync::Arc;

use serde::{Deserialize, Serialize};

use super::term::{Comparison, Metric, Term, Threshold};
use crate::id::{AttributeId, LabelId, TypeId};
use crate::value::Value;

/// The right-hand side of a metric.
#[derive(Debug, Clone, Copy, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub(super) enum Limit {
    Threshold(Threshold),
    /// The value of this attribute of the first node.
    Attribute(AttributeId),
}

/// A part of a conjunction. `T` is a term as written, or a slot when compiled.
#[derive(Debug, Clone, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub(super) enum Atom<T> {
    Edge { from: T, label: LabelId, to: T },
    Present { holder: Carrier<T>, attribute: AttributeId },
    Guard { holder: Carrier<T>, attribute: AttributeId, comparison: Comparison, operand: Right<T> },
    Distinct(T, T),
    IsA(T, TypeId),
    Metric { metric: Metric, from: T, to: T, comparison: Comparison, limit: Limit },
    Without(Conjunction<T>),
}

#[derive(Debug, Clone, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub(super) enum Carrier<T> {
    Node(T),
    Edge { from: T, label: LabelId, to: T },
}

#[derive(Debug, Clone, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub(super) enum Right<T> {
    Value(Value),
    Term(T),
    Attribute(Carrier<T>, AttributeId),
}

/// Parts that must all hold, with the variables that are declared here.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub(super) struct Conjunction<T> {
    pub(super) variables: Vec<T>,
    pub(super) atoms: Vec<Atom<T>>,
}

/// A pattern as it was written, without a vocabulary: plain data, for files and other processes.
/// [`PatternSource::build`] checks it as a [`PatternBuilder`](super::PatternBuilder) does. The reader of the format
/// must limit the depth of nesting, as that of JSON does.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub struct PatternSource {
    /// Names and types of the top-level variables.
    pub(super) variables: Vec<(Arc<str>, TypeId)>,
    /// Types of the local variables.
    pub(super) locals: Vec<TypeId>,
    pub(super) body: Conjunction<Term>,
}
