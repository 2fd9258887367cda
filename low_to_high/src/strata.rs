//! The order of derivation: strongly connected components of "is derived from".
//!
//! Idea: Tarjan's algorithm yields a component after all components on which it depends. The predicates of one component
//! are derived from each other and need a fixpoint; a least one exists only without negation inside the component.
//! Invariant: no component depends negatively on itself (the program is stratified).
//!
//! Source: Apt, Blair & Walker, "Towards a theory of declarative knowledge", 1988. The components are petgraph's.

use pddl::model::PredicateId;
use petgraph::algo::tarjan_scc;
use petgraph::graph::{DiGraph, NodeIndex};
use vocabulary::{Conjunction, Literal};

use crate::axiom::Axiom;

/// Predicates that are derived together.
#[derive(Debug)]
pub(crate) struct Component {
    pub(crate) predicates: Vec<PredicateId>,
    /// Positions of their axioms.
    pub(crate) axioms: Vec<usize>,
    /// Whether a predicate of the component depends on one of the component.
    pub(crate) recursive: bool,
}

/// How an axiom depends on a predicate.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Sign {
    Positive,
    Negative,
}

/// The components in an order in which they can be derived.
///
/// # Errors
/// An axiom, and a predicate of its own component that it denies.
pub(crate) fn components(axioms: &[Axiom]) -> Result<Vec<Component>, (usize, PredicateId)> {
    let uses: Vec<Vec<(PredicateId, Sign)>> = axioms.iter().map(derived_literals).collect();
    let mut derived: Vec<PredicateId> = axioms.iter().map(|axiom| axiom.predicate).collect();
    derived.sort_unstable();
    derived.dedup();
    let node = |predicate: &PredicateId| derived.binary_search(predicate).ok();
    let mut graph = DiGraph::<PredicateId, ()>::new();
    let nodes: Vec<NodeIndex> = derived.iter().map(|&predicate| graph.add_node(predicate)).collect();
    for (axiom, uses) in axioms.iter().zip(&uses) {
        for (on, _) in uses {
            if let (Some(from), Some(to)) = (node(&axiom.predicate), node(on)) {
                graph.update_edge(nodes[from], nodes[to], ());
            }
        }
    }
    let mut components = Vec::new();
    for found in tarjan_scc(&graph) {
        let mut predicates: Vec<PredicateId> = found.into_iter().map(|node| graph[node]).collect();
        predicates.sort_unstable();
        let own: Vec<usize> =
            (0..axioms.len()).filter(|&at| predicates.contains(&axioms[at].predicate)).collect();
        let mut recursive = false;
        for &at in &own {
            for &(on, sign) in &uses[at] {
                if predicates.contains(&on) {
                    recursive = true;
                    if sign == Sign::Negative {
                        return Err((at, on));
                    }
                }
            }
        }
        components.push(Component { predicates, axioms: own, recursive });
    }
    Ok(components)
}

/// The derived predicates in the body of an axiom.
fn derived_literals(axiom: &Axiom) -> Vec<(PredicateId, Sign)> {
    fn collect(part: &Conjunction, sign: Sign, found: &mut Vec<(PredicateId, Sign)>) {
        for (literal, _) in &part.literals {
            if let Literal::Derived { predicate, .. } = literal {
                found.push((*predicate, sign));
            }
        }
        // A literal below two negations could count as positive if it is outside the component. Counting it as negative
        // rejects some programs that have a meaning, and accepts none that have no meaning.
        part.without.iter().for_each(|part| collect(part, Sign::Negative, found));
    }
    let mut found = Vec::new();
    axiom.body.iter().for_each(|part| collect(part, Sign::Positive, &mut found));
    found
}
