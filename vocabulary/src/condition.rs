//! A condition over the graph, compiled to patterns.
//!
//! Idea: each disjunct is one [`Alternative`]. Quantified variables are projected out of its matches. The outermost
//! conjuncts are also compiled one by one, so that `unmet` can explain a condition by the first part that fails.
//!
//! Semantics: a variable ranges over the nodes of its types that exist in the snapshot. A comparison with an undefined
//! attribute does not hold. A named node that does not exist has no edges.

use std::collections::BTreeSet;
use std::sync::Arc;

use dsr::{Keep, Mentions, NodeId, PatternError, Snapshot, Vocabulary};
use pddl::Span;
use pddl::model::VariableId;

use crate::alternative::Alternative;
use crate::binding::Binding;
use crate::disjuncts::{MAX_ALTERNATIVES, typings};
use crate::formula::Formula;
use crate::link_error::{LinkError, LinkErrorKind};
use crate::located::Located;
use crate::scope::Scope;

/// A compiled condition of one schema.
#[derive(Debug, Clone)]
pub struct Condition {
    pub(crate) vocabulary: Arc<Vocabulary>,
    pub(crate) scope: Scope,
    alternatives: Vec<Alternative>,
    mentions: Mentions,
    /// The outermost conjuncts, in the order of the source.
    pub(crate) parts: Vec<Part>,
}

/// An outermost conjunct.
#[derive(Debug, Clone)]
pub(crate) struct Part {
    pub(crate) formula: Formula,
    pub(crate) alternatives: Vec<Alternative>,
}

impl Condition {
    /// Compiles a formula; `visible` are the variables whose bindings matter, ascending.
    pub(crate) fn compile(
        vocabulary: &Arc<Vocabulary>,
        scope: &Scope,
        formula: &Formula,
        visible: &[VariableId],
    ) -> Result<Self, LinkError> {
        let alternatives = alternatives(vocabulary, scope, formula, visible)?;
        let mut parts = Vec::new();
        for part in formula.conjuncts() {
            let alternatives = alternatives_of_part(vocabulary, scope, part)?;
            parts.push(Part { formula: part.clone(), alternatives });
        }
        let mut mentions = Mentions::default();
        for alternative in &alternatives {
            mentions.extend(alternative.pattern().mentions());
        }
        Ok(Self { vocabulary: Arc::clone(vocabulary), scope: scope.clone(), alternatives, mentions, parts })
    }

    /// The alternatives as patterns; empty if it can never hold.
    pub fn alternatives(&self) -> &[Alternative] {
        &self.alternatives
    }

    /// Whether it is the empty conjunction.
    pub fn is_always(&self) -> bool {
        self.parts.is_empty()
    }

    /// The tokens on which it depends. A delta that touches none of them cannot change it.
    pub fn mentions(&self) -> &Mentions {
        &self.mentions
    }

    /// Whether some completion of the binding makes it hold.
    pub fn holds(&self, snapshot: &Snapshot, binding: &Binding) -> bool {
        self.alternatives
            .iter()
            .any(|alternative| alternative.pattern().holds_with(snapshot, &alternative.fixed(binding)))
    }

    /// All completions of the binding that make it hold, ordered by their nodes, variable by variable.
    pub fn bindings(&self, snapshot: &Snapshot, binding: &Binding) -> Vec<Binding> {
        completions(&self.alternatives, snapshot, binding)
    }

    /// The condition as one that a reflex keeps up.
    pub fn keep(&self, binding: &Binding) -> Keep {
        Keep { any: self.alternatives.iter().map(|alternative| alternative.bound(binding)).collect() }
    }
}

/// The completions of a binding by any of the alternatives.
pub(crate) fn completions(
    alternatives: &[Alternative],
    snapshot: &Snapshot,
    binding: &Binding,
) -> Vec<Binding> {
    let mut found: BTreeSet<Vec<(VariableId, NodeId)>> = BTreeSet::new();
    for alternative in alternatives {
        for matched in alternative.pattern().matches_with(snapshot, &alternative.fixed(binding)) {
            // The visible variables come first in the pattern, so a match starts with their nodes.
            found.insert(alternative.variables().map(|(v, _)| v).zip(matched.iter().copied()).collect());
        }
    }
    found
        .into_iter()
        .map(|nodes| {
            let mut completed = binding.clone();
            for (variable, node) in nodes {
                completed.bind(variable, node);
            }
            completed
        })
        .collect()
}

fn alternatives(
    vocabulary: &Vocabulary,
    scope: &Scope,
    formula: &Formula,
    visible: &[VariableId],
) -> Result<Vec<Alternative>, LinkError> {
    let too_many = || Located::new(first_span(formula), LinkErrorKind::TooManyAlternatives);
    let refused = |error: PatternError| Located::new(first_span(formula), LinkErrorKind::Pattern(error));
    let disjuncts = formula.disjuncts(scope).ok_or_else(too_many)?;
    let typings = typings(visible, scope).ok_or_else(too_many)?;
    if typings.len() * disjuncts.len() > MAX_ALTERNATIVES {
        return Err(too_many());
    }
    let mut found = Vec::new();
    for types in &typings {
        for conjunction in &disjuncts {
            found.push(Alternative::compile(vocabulary, scope, types, conjunction).map_err(refused)?);
        }
    }
    Ok(found)
}

fn alternatives_of_part(
    vocabulary: &Vocabulary,
    scope: &Scope,
    part: &Formula,
) -> Result<Vec<Alternative>, LinkError> {
    let free: Vec<_> = part.free().into_iter().filter(|&variable| scope.is_node(variable)).collect();
    alternatives(vocabulary, scope, part, &free)
}

/// The place of the first literal.
pub(crate) fn first_span(formula: &Formula) -> Span {
    match formula {
        Formula::All(parts) | Formula::Any(parts) => parts.first().map(first_span).unwrap_or_default(),
        Formula::Some(_, part) | Formula::None(_, part) => first_span(part),
        Formula::Literal(_, span) => *span,
    }
}
