//! Patterns: a small subgraph with variables, and the ways to find it in a snapshot.
//!
//! Problem: agents should see the part of the graph that concerns them, not all of it, and the mapping from
//! subgraphs to actions should be text, not code in each agent. Idea: a conjunction of edges, types, attribute guards,
//! inequalities, distances and negated conjunctions over typed variables, checked against the vocabulary when it
//! is built, compiled once with a join order. A disjunction is a `Vec<Pattern>`.
//!
//! Semantics: a match gives each top-level variable a node of its type such that all parts hold. Variables need
//! not be distinct unless the pattern says so. A guard on an attribute that is absent does not hold, whatever the
//! comparison. A negated part holds if its own conjunction has no match; its local variables end with it.
//! Matches come in the order of node ids, variable by variable, whatever the join order.

mod builder;
mod check;
mod clue;
mod held;
mod matcher;
mod negated;
mod plan;
mod rigid;
mod seed;
mod text;

use std::ops::Deref;
use std::sync::Arc;

use serde::{Deserialize, Serialize, Serializer};

pub use self::builder::PatternBuilder;
pub use self::check::PatternError;
pub(crate) use self::clue::{Clue, Ordered, Tip, ValueKey, Way};
pub(crate) use self::held::Held;
use self::negated::Part;
pub(crate) use self::negated::{Known, Moves, Witnesses};
use self::plan::{Mask, Step};
use self::rigid::End;
pub(crate) use self::rigid::moved;
use self::seed::Seedling;
pub(crate) use self::seed::{Fixed, Route, Slices};
pub use self::text::PatternTextError;
use crate::id::{AttributeId, LabelId, NodeId, TypeId};
use crate::mentions::Mentions;
use crate::value::Value;
use crate::vocabulary::Vocabulary;

/// A variable of a pattern.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
pub struct Variable {
    scope: Scope,
    index: u16,
}

impl Variable {
    /// The position of the variable in a [`Binding`]; `None` for a local of a negated part.
    pub fn position(self) -> Option<usize> {
        (self.scope == Scope::Top).then_some(usize::from(self.index))
    }
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
enum Scope {
    Top,
    Local,
}

/// What may stand where a node is meant.
#[derive(Debug, Clone, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Term {
    /// A variable.
    Variable(Variable),
    /// A node, by id.
    Node(NodeId),
    /// A node, by name, looked up in each snapshot.
    Named(Arc<str>),
}

impl From<Variable> for Term {
    fn from(variable: Variable) -> Self {
        Self::Variable(variable)
    }
}

impl From<NodeId> for Term {
    fn from(node: NodeId) -> Self {
        Self::Node(node)
    }
}

impl From<&str> for Term {
    fn from(name: &str) -> Self {
        Self::Named(name.into())
    }
}

/// What carries an attribute in a pattern.
#[derive(Debug, Clone, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
#[expect(missing_docs, reason = "the fields are the terms of the variant")]
pub enum HolderTerm {
    /// A node.
    Node(Term),
    /// An edge, which thereby must exist.
    Edge { from: Term, label: LabelId, to: Term },
}

impl HolderTerm {
    /// A node.
    pub fn node(node: impl Into<Term>) -> Self {
        Self::Node(node.into())
    }

    /// An edge.
    pub fn edge(from: impl Into<Term>, label: LabelId, to: impl Into<Term>) -> Self {
        Self::Edge { from: from.into(), label, to: to.into() }
    }
}

impl<T: Into<Term>> From<T> for HolderTerm {
    fn from(node: T) -> Self {
        Self::Node(node.into())
    }
}

/// How two values are compared. Order is for numbers only.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
#[expect(missing_docs, reason = "the names say it")]
pub enum Comparison {
    Equal,
    NotEqual,
    Less,
    LessOrEqual,
    Greater,
    GreaterOrEqual,
}

/// The right-hand side of an attribute guard.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Operand {
    /// A constant.
    Value(Value),
    /// A node; with [`Comparison::Equal`], a variable that is not bound yet is bound to the attribute's value.
    Term(Term),
    /// Another attribute.
    Attribute(HolderTerm, AttributeId),
}

impl From<Value> for Operand {
    fn from(value: Value) -> Self {
        Self::Value(value)
    }
}

impl From<f64> for Operand {
    fn from(number: f64) -> Self {
        Self::Value(Value::Number(number))
    }
}

impl From<bool> for Operand {
    fn from(truth: bool) -> Self {
        Self::Value(Value::Bool(truth))
    }
}

impl From<Variable> for Operand {
    fn from(variable: Variable) -> Self {
        Self::Term(Term::Variable(variable))
    }
}

impl From<Term> for Operand {
    fn from(term: Term) -> Self {
        Self::Term(term)
    }
}

/// What is measured between two frames, when it is asked for.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Metric {
    /// Between the origins, in metres.
    Distance,
    /// How far the origin of the second is off the x axis of the first, in its plane and to either side, in radians.
    Bearing,
}

/// A number that a metric is held against. With hysteresis there are two, so that somebody who stands at the limit does
/// not come and go with each measurement: in the band between them a match stays what it was, there or not; without a
/// history it is not there. In a negated part this is so for the match of the pattern around it: "nobody near" appears
/// when everybody has passed the second number, and stays until somebody has passed the first.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Threshold {
    /// What is measured begins to compare so when the comparison holds with this.
    pub appears: f64,
    /// It has ceased to when the comparison no longer holds with this, which is no stricter.
    pub disappears: f64,
}

impl From<f64> for Threshold {
    fn from(number: f64) -> Self {
        Self { appears: number, disappears: number }
    }
}

/// What a metric is held against.
#[derive(Debug, Clone, Copy, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
enum Limit {
    Threshold(Threshold),
    /// An attribute of the first node.
    Attribute(AttributeId),
}

/// Which of the two numbers of a threshold counts: what it takes for a match to appear, or to stay. Under a negation it
/// is the other way round, since what is hard to find there is easy to be without.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Strictness {
    Appears,
    Stays,
}

impl Strictness {
    fn negated(self) -> Self {
        match self {
            Self::Appears => Self::Stays,
            Self::Stays => Self::Appears,
        }
    }
}

/// A part of a conjunction. Terms are slots once compiled.
#[derive(Debug, Clone, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
enum Atom<T> {
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
enum Carrier<T> {
    Node(T),
    Edge { from: T, label: LabelId, to: T },
}

#[derive(Debug, Clone, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
enum Right<T> {
    Value(Value),
    Term(T),
    Attribute(Carrier<T>, AttributeId),
}

/// Parts that must all hold, with the variables that begin here.
#[derive(Debug, Clone, Serialize, Deserialize)]
struct Conjunction<T> {
    variables: Vec<T>,
    atoms: Vec<Atom<T>>,
}

/// Where the node of a variable or of a constant is kept while matching.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
struct Slot(u8);

/// The most variables and constants that one pattern may have.
const SLOTS: usize = 64;

#[derive(Debug, Clone)]
enum Constant {
    Node(NodeId),
    Named(Arc<str>),
}

/// A pattern as it was written, without a vocabulary: plain data, for files and other processes. [`PatternSource::build`]
/// checks it as a [`PatternBuilder`] does. The format must limit how deeply it nests, as JSON's reader does.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub struct PatternSource {
    /// Names and types of the top-level variables.
    variables: Vec<(Arc<str>, TypeId)>,
    /// Types of the local variables.
    locals: Vec<TypeId>,
    body: Conjunction<Term>,
}

impl PatternSource {
    /// The pattern of a vocabulary.
    pub fn build(self, vocabulary: &Vocabulary) -> Result<Pattern, PatternError> {
        check::compile(vocabulary, self)
    }
}

impl Serialize for Pattern {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        self.source.serialize(serializer)
    }
}

/// A compiled pattern. Written by serde as its [`PatternSource`].
#[derive(Debug, Clone)]
pub struct Pattern {
    source: Arc<PatternSource>,
    /// Names and types of the top-level variables, which have the first slots.
    variables: Vec<(Arc<str>, TypeId)>,
    /// Types of the local variables, which have the next slots.
    locals: Vec<TypeId>,
    /// The constants, which have the last slots.
    constants: Vec<Constant>,
    body: Conjunction<Slot>,
    /// Where joins begin when something changes.
    seeds: Vec<Seedling>,
    /// The ends of each metric, where joins begin when something moves.
    measured: Vec<[End; 2]>,
    /// The negated parts that can be judged by what has moved in them.
    parts: Vec<Part>,
    /// The join order when no variable is fixed.
    plan: Vec<Step>,
    /// The join order when all variables are.
    judgement: Vec<Step>,
    mentions: Mentions,
    /// Whether some threshold has hysteresis.
    remembers: bool,
}

impl Pattern {
    /// The names and types of the variables, in the order of a [`Binding`].
    pub fn variables(&self) -> impl Iterator<Item = (&str, TypeId)> + '_ {
        self.variables.iter().map(|(name, node_type)| (&**name, *node_type))
    }

    /// Where a match has the node of a variable: of the pattern's own, not of a negated part or of another pattern.
    fn place_of(&self, variable: Variable) -> Option<usize> {
        variable.position().filter(|&at| at < self.variables.len())
    }

    /// Whether a match gives the variable a node.
    pub(crate) fn gives(&self, variable: Variable) -> bool {
        self.place_of(variable).is_some()
    }

    /// How it was written.
    pub fn source(&self) -> &Arc<PatternSource> {
        &self.source
    }

    /// The variable of that name.
    pub fn variable(&self, name: &str) -> Option<Variable> {
        let at = self.variables.iter().position(|(variable, _)| **variable == *name)?;
        Some(Variable { scope: Scope::Top, index: u16::try_from(at).ok()? })
    }

    /// The tokens on which the matches depend: a delta that touches none of them changes no match.
    pub fn mentions(&self) -> &Mentions {
        &self.mentions
    }
}

/// Join orders that a subscriber has needed, by what was fixed.
#[derive(Debug, Default)]
pub(crate) struct Plans(Vec<(Mask, Vec<Step>)>);

/// One match: a node for each variable, in the order in which they were declared.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(transparent)]
pub struct Binding(Vec<NodeId>);

impl Binding {
    /// The node of a variable; `None` for a local of a negated part.
    pub fn get(&self, variable: Variable) -> Option<NodeId> {
        self.0.get(variable.position()?).copied()
    }
}

impl From<Vec<NodeId>> for Binding {
    fn from(nodes: Vec<NodeId>) -> Self {
        Self(nodes)
    }
}

impl Deref for Binding {
    type Target = [NodeId];

    fn deref(&self) -> &[NodeId] {
        &self.0
    }
}
