//! Conditions as logic over tokens: names resolved, negation normal form.
//!
//! Idea: the only negation is [`Formula::None`], "no binding of these variables makes it hold". A universal is the
//! absence of a counterexample; a negated literal is the absence of that literal, with no variables. Patterns of the
//! graph have the same single form of negation.

use dsr::{AttributeId, Comparison, LabelId, Value};
use pddl::Span;
use pddl::model::{Name, PredicateId, VariableId};

/// A variable or a node that has a name.
#[derive(Debug, Clone, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Term {
    /// A slot of the schema.
    Variable(VariableId),
    /// The node of that name in the graph that is asked.
    Named(Name),
}

/// The node or edge that has an attribute.
#[derive(Debug, Clone, PartialEq, Eq)]
#[expect(missing_docs, reason = "the fields are the terms of the variant")]
pub enum Holder {
    /// A node.
    Node(Term),
    /// An edge.
    Edge { from: Term, label: LabelId, to: Term },
}

impl Holder {
    /// The nodes that it names.
    pub fn terms(&self) -> Vec<&Term> {
        match self {
            Self::Node(node) => vec![node],
            Self::Edge { from, to, .. } => vec![from, to],
        }
    }
}

/// What an attribute is compared with.
#[derive(Debug, Clone, PartialEq)]
pub enum Right {
    /// A number, text or truth value.
    Value(Value),
    /// A node.
    Term(Term),
    /// Another attribute.
    Attribute(Holder, AttributeId),
}

/// An atomic condition on the graph.
#[derive(Debug, Clone, PartialEq)]
#[expect(missing_docs, reason = "the fields are the terms of the variant")]
pub enum Literal {
    /// The edge exists.
    Edge { from: Term, label: LabelId, to: Term },
    /// The attribute has a value.
    Present { holder: Holder, attribute: AttributeId },
    /// The attribute has a value, and the comparison holds.
    Compare { holder: Holder, attribute: AttributeId, comparison: Comparison, right: Right },
    /// Both terms are the same node.
    Same(Term, Term),
    /// The terms are different nodes.
    Differ(Term, Term),
    /// The frames are connected, and the comparison holds for their distance in metres.
    Distance { from: Term, to: Term, comparison: Comparison, metres: f64 },
    /// A predicate that is not a token: the crate that asked for the formula evaluates it.
    Derived { predicate: PredicateId, name: Name, arguments: Vec<Term> },
}

impl Literal {
    /// The nodes that it names, in order.
    pub fn terms(&self) -> Vec<&Term> {
        match self {
            Self::Edge { from, to, .. } | Self::Distance { from, to, .. } => vec![from, to],
            Self::Same(a, b) | Self::Differ(a, b) => vec![a, b],
            Self::Present { holder, .. } => holder.terms(),
            Self::Compare { holder, right, .. } => {
                let mut terms = holder.terms();
                match right {
                    Right::Value(_) => {}
                    Right::Term(term) => terms.push(term),
                    Right::Attribute(holder, _) => terms.extend(holder.terms()),
                }
                terms
            }
            Self::Derived { arguments, .. } => arguments.iter().collect(),
        }
    }

    /// The variables that it names, in order, with repetitions.
    pub fn variables(&self) -> impl Iterator<Item = VariableId> {
        self.terms().into_iter().filter_map(|term| match term {
            Term::Variable(variable) => Some(*variable),
            Term::Named(_) => None,
        })
    }
}

/// A condition.
#[derive(Debug, Clone, PartialEq)]
pub enum Formula {
    /// All of them; empty is true.
    All(Vec<Formula>),
    /// One of them; empty is false.
    Any(Vec<Formula>),
    /// Some binding of these variables makes it hold.
    Some(Vec<VariableId>, Box<Formula>),
    /// No binding of these variables makes it hold.
    None(Vec<VariableId>, Box<Formula>),
    /// A literal with its place in the source.
    Literal(Literal, Span),
}

impl Formula {
    /// Always true.
    pub fn always() -> Self {
        Self::All(Vec::new())
    }

    /// The opposite.
    #[must_use]
    pub fn negated(self) -> Self {
        match self {
            Self::All(parts) => Self::Any(parts.into_iter().map(Self::negated).collect()),
            Self::Any(parts) => Self::All(parts.into_iter().map(Self::negated).collect()),
            Self::Some(variables, part) => Self::None(variables, part),
            Self::None(variables, part) if variables.is_empty() => *part,
            Self::None(variables, part) => Self::Some(variables, part),
            Self::Literal(Literal::Same(a, b), span) => Self::Literal(Literal::Differ(a, b), span),
            Self::Literal(Literal::Differ(a, b), span) => Self::Literal(Literal::Same(a, b), span),
            literal @ Self::Literal(..) => Self::None(Vec::new(), Box::new(literal)),
        }
    }

    /// The parts of the outermost conjunction, nested ones included.
    pub fn conjuncts(&self) -> Vec<&Self> {
        match self {
            Self::All(parts) => parts.iter().flat_map(Self::conjuncts).collect(),
            other => vec![other],
        }
    }

    /// The free variables, ascending.
    pub fn free(&self) -> Vec<VariableId> {
        let mut found = Vec::new();
        self.collect(&mut Vec::new(), &mut found);
        found.sort_unstable();
        found.dedup();
        found
    }

    fn collect(&self, hidden: &mut Vec<VariableId>, found: &mut Vec<VariableId>) {
        match self {
            Self::All(parts) | Self::Any(parts) => parts.iter().for_each(|part| part.collect(hidden, found)),
            Self::Some(variables, part) | Self::None(variables, part) => {
                let before = hidden.len();
                hidden.extend(variables);
                part.collect(hidden, found);
                hidden.truncate(before);
            }
            Self::Literal(literal, _) => {
                found.extend(literal.variables().filter(|variable| !hidden.contains(variable)));
            }
        }
    }
}
