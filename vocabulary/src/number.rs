//! Numeric expressions over a graph.

use dsr::{AttributeId, Mentions, NodeId, Snapshot};
use pddl::model::ArithmeticOperator;

use crate::binding::Binding;
use crate::formula::{Holder, Term};

/// A numeric expression with its names resolved.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Number {
    Constant(f64),
    Attribute(Holder, AttributeId),
    Distance(Term, Term),
    Arithmetic(ArithmeticOperator, Vec<Number>),
}

impl Number {
    /// The value, if it is the same in every graph.
    pub(crate) fn constant(&self) -> Option<f64> {
        match self {
            Self::Constant(number) => Some(*number),
            Self::Attribute(..) | Self::Distance(..) => None,
            Self::Arithmetic(operator, operands) => {
                calculate(*operator, &operands.iter().map(Self::constant).collect::<Option<Vec<_>>>()?)
            }
        }
    }

    /// Adds the tokens that its value depends on.
    pub(crate) fn mention(&self, mentions: &mut Mentions) {
        match self {
            Self::Constant(_) => {}
            Self::Attribute(holder, attribute) => mention_attribute(holder, *attribute, mentions),
            Self::Distance(..) => mentions.add_transforms(),
            Self::Arithmetic(_, operands) => operands.iter().for_each(|operand| operand.mention(mentions)),
        }
    }

    /// The value in a graph; `None` if a part is undefined or unbound.
    pub(crate) fn value(&self, snapshot: &Snapshot, binding: &Binding) -> Option<f64> {
        match self {
            Self::Constant(number) => Some(*number),
            Self::Attribute(holder, attribute) => {
                snapshot.attribute(holder_in(holder, snapshot, binding)?, *attribute)?.as_number()
            }
            Self::Distance(a, b) => {
                snapshot.distance(node_in(a, snapshot, binding)?, node_in(b, snapshot, binding)?).ok()
            }
            Self::Arithmetic(operator, operands) => {
                let values: Option<Vec<_>> =
                    operands.iter().map(|operand| operand.value(snapshot, binding)).collect();
                calculate(*operator, &values?)
            }
        }
    }
}

/// Adds the tokens of an attribute: itself, and its edge if an edge holds it.
pub(crate) fn mention_attribute(holder: &Holder, attribute: AttributeId, mentions: &mut Mentions) {
    mentions.add_attribute(attribute);
    if let Holder::Edge { label, .. } = holder {
        mentions.add_label(*label);
    }
}

/// The result; `None` if it is not a finite number.
pub(crate) fn calculate(operator: ArithmeticOperator, operands: &[f64]) -> Option<f64> {
    let (&first, rest) = operands.split_first()?;
    let result = match operator {
        ArithmeticOperator::Add => rest.iter().fold(first, |sum, x| sum + x),
        ArithmeticOperator::Multiply => rest.iter().fold(first, |product, x| product * x),
        ArithmeticOperator::Subtract if rest.is_empty() => -first,
        ArithmeticOperator::Subtract => rest.iter().fold(first, |left, x| left - x),
        ArithmeticOperator::Divide => rest.iter().fold(first, |left, x| left / x),
    };
    result.is_finite().then_some(result)
}

/// The node of a term, under a binding.
pub(crate) fn node_in(term: &Term, snapshot: &Snapshot, binding: &Binding) -> Option<NodeId> {
    match term {
        Term::Variable(variable) => binding.node(*variable),
        Term::Named(name) => snapshot.node(name),
    }
}

fn holder_in(holder: &Holder, snapshot: &Snapshot, binding: &Binding) -> Option<dsr::Holder> {
    Some(match holder {
        Holder::Node(node) => dsr::Holder::Node(node_in(node, snapshot, binding)?),
        Holder::Edge { from, label, to } => dsr::Holder::Edge(dsr::EdgeKey {
            from: node_in(from, snapshot, binding)?,
            label: *label,
            to: node_in(to, snapshot, binding)?,
        }),
    })
}
