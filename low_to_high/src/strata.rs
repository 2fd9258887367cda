//! The order of derivation: strongly connected components of "is derived from".
//!
//! Idea: Tarjan's components come out with every dependency before what depends on it. Inside a component,
//! predicates are derived from each other and need a fixpoint, which exists and is least only without negation
//! there. Invariant: no component depends negatively on itself (the program is stratified).
//!
//! Source: Apt, Blair & Walker, "Towards a theory of declarative knowledge", 1988; Tarjan, "Depth-first search and
//! linear graph algorithms", SIAM J. Comput. 1972.

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
    /// Whether one of them depends on one of them.
    pub(crate) recursive: bool,
}

/// How an axiom depends on a predicate.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Sign {
    Positive,
    Negative,
}

/// The components in an order in which they can be derived; or an axiom and the predicate of its own component that it
/// denies.
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
        // Below a negation a second one is positive again for the least model only if it is free of the component;
        // calling it negative refuses some programs that have one meaning, and none that have not.
        part.without.iter().for_each(|part| collect(part, Sign::Negative, found));
    }
    let mut found = Vec::new();
    axiom.body.iter().for_each(|part| collect(part, Sign::Positive, &mut found));
    found
}
