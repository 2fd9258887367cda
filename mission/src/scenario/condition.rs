//! A condition over the graph, in a scenario.

use pddl::Span;
use pddl::model::{Condition, Variables};

use crate::fragment;
use crate::layers::Layers;
use diagnostics::toml::{Reader, Text};

/// A condition over the graph.
#[derive(Clone, Debug)]
pub struct GraphCondition {
    /// As written.
    pub text: String,
    /// In terms of [`Layers::nodes`]. Its inner spans belong to no file; report [`GraphCondition::span`].
    pub condition: Condition,
    /// Its quantified variables.
    pub variables: Variables,
    /// Its place in the scenario.
    pub span: Span,
}

/// Reads the condition in `text`.
pub(super) fn read(reader: &mut Reader<'_>, layers: &Layers, text: &Text) -> Option<GraphCondition> {
    let (condition, variables) = fragment::read(reader, &layers.nodes, text)?;
    Some(GraphCondition { text: text.value.clone(), condition, variables, span: text.span })
}
