//! One alternative of a condition: a pattern of the graph, and the schema's variable for each of the pattern's own.

use std::sync::Arc;

use dsr::{Bound, HolderTerm, NodeId, Operand, Pattern, PatternBuilder, PatternError, Variable, Vocabulary};
use pddl::model::VariableId;
use rustc_hash::FxHashMap;

use crate::binding::Binding;
use crate::disjuncts::Conjunction;
use crate::formula::{Holder, Literal, Right, Term};
use crate::scope::Scope;

/// A compiled alternative.
#[derive(Debug, Clone)]
pub struct Alternative {
    pattern: Arc<Pattern>,
    /// The visible variables of the schema, each with its variable in the pattern. They come first in the pattern.
    visible: Vec<(VariableId, Variable)>,
}

impl Alternative {
    /// Compiles a conjunction whose visible variables have these types.
    pub(crate) fn compile(
        vocabulary: &Vocabulary,
        scope: &Scope,
        visible: &[(VariableId, dsr::TypeId)],
        conjunction: &Conjunction,
    ) -> Result<Self, PatternError> {
        let mut builder = PatternBuilder::new(vocabulary);
        let mut variables = FxHashMap::default();
        let mut own = Vec::new();
        for &(variable, id) in visible {
            let made = builder.variable(&scope.slot(variable).name, id);
            variables.insert(variable, made);
            own.push((variable, made));
        }
        write(&mut builder, &mut variables, scope, conjunction);
        Ok(Self { pattern: Arc::new(builder.build()?), visible: own })
    }

    /// The pattern.
    pub fn pattern(&self) -> &Arc<Pattern> {
        &self.pattern
    }

    /// The variables of the schema that the pattern has, in the order of its matches.
    pub fn variables(&self) -> impl Iterator<Item = (VariableId, Variable)> + '_ {
        self.visible.iter().copied()
    }

    /// The nodes to which a binding fixes variables of the pattern.
    pub fn fixed(&self, binding: &Binding) -> Vec<(Variable, NodeId)> {
        let fixed = |&(variable, own): &(VariableId, Variable)| Some((own, binding.node(variable)?));
        self.visible.iter().filter_map(fixed).collect()
    }

    /// The pattern together with the nodes that a binding fixes, for reflexes.
    pub fn bound(&self, binding: &Binding) -> Bound {
        Bound { pattern: Arc::clone(&self.pattern), binding: self.fixed(binding) }
    }
}

fn write(
    builder: &mut PatternBuilder<'_>,
    variables: &mut FxHashMap<VariableId, Variable>,
    scope: &Scope,
    part: &Conjunction,
) {
    for &(variable, id) in &part.variables {
        let made = builder.variable(&scope.slot(variable).name, id);
        variables.insert(variable, made);
    }
    for (literal, _) in &part.literals {
        write_literal(builder, variables, literal);
    }
    for without in &part.without {
        builder.without(|builder| write(builder, variables, scope, without));
    }
}

fn write_literal(
    builder: &mut PatternBuilder<'_>,
    variables: &FxHashMap<VariableId, Variable>,
    literal: &Literal,
) {
    let term = |term: &Term| term_of(variables, term);
    let holder = |holder: &Holder| match holder {
        Holder::Node(node) => HolderTerm::node(term(node)),
        Holder::Edge { from, label, to } => HolderTerm::edge(term(from), *label, term(to)),
    };
    match literal {
        Literal::Edge { from, label, to } => {
            builder.edge(term(from), *label, term(to));
        }
        Literal::Present { holder: on, attribute } => {
            builder.present(holder(on), *attribute);
        }
        Literal::Compare { holder: on, attribute, comparison, right } => {
            let operand = match right {
                Right::Value(value) => Operand::Value(value.clone()),
                Right::Term(node) => Operand::Term(term(node)),
                Right::Attribute(other, its) => Operand::Attribute(holder(other), *its),
            };
            builder.guard(holder(on), *attribute, *comparison, operand);
        }
        Literal::Differ(a, b) => {
            builder.distinct(term(a), term(b));
        }
        // Patterns cannot say that two nodes are equal; they can deny that they differ.
        Literal::Same(a, b) => {
            builder.without(|builder| {
                builder.distinct(term(a), term(b));
            });
        }
        Literal::Distance { from, to, comparison, metres } => {
            builder.distance(term(from), term(to), *comparison, *metres);
        }
        Literal::Derived { .. } => {
            debug_assert!(false, "the translator refuses derived predicates in conditions");
        }
    }
}

fn term_of(variables: &FxHashMap<VariableId, Variable>, term: &Term) -> dsr::Term {
    match term {
        Term::Variable(variable) => dsr::Term::Variable(
            *variables.get(variable).expect("free or quantified: declared before its use"),
        ),
        Term::Named(name) => dsr::Term::from(name.as_str()),
    }
}
