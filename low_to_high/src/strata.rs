//! The order of derivation: strongly connected components of "is derived from".
//!
//! Idea: Tarjan's components come out with every dependency before what depends on it. Inside a component,
//! predicates are derived from each other and need a fixpoint, which exists and is least only without negation
//! there. Invariant: no component depends negatively on itself (the program is stratified).
//!
//! Source: Apt, Blair & Walker, "Towards a theory of declarative knowledge", 1988; Tarjan, "Depth-first search and
//! linear graph algorithms", SIAM J. Comput. 1972.

use pddl::model::PredicateId;
use rustc_hash::FxHashMap;
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

/// The components in an order in which they can be derived; an axiom and the predicate that it denies in its own
/// component, if there is one.
pub(crate) fn components(axioms: &[Axiom]) -> Result<Vec<Component>, (usize, PredicateId)> {
    let mut order: Vec<PredicateId> = axioms.iter().map(|axiom| axiom.predicate).collect();
    order.sort_unstable();
    order.dedup();
    let mut search = Search {
        axioms,
        edges: axioms.iter().map(dependencies).collect(),
        numbers: FxHashMap::default(),
        low: FxHashMap::default(),
        stack: Vec::new(),
        found: Vec::new(),
    };
    for &predicate in &order {
        if !search.numbers.contains_key(&predicate) {
            search.visit(predicate);
        }
    }
    let Search { edges, found, .. } = search;
    let mut components = Vec::new();
    for mut predicates in found {
        predicates.sort_unstable();
        let own: Vec<usize> =
            (0..axioms.len()).filter(|&at| predicates.contains(&axioms[at].predicate)).collect();
        let mut recursive = false;
        for &at in &own {
            for &(on, sign) in &edges[at] {
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

fn dependencies(axiom: &Axiom) -> Vec<(PredicateId, Sign)> {
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

struct Search<'a> {
    axioms: &'a [Axiom],
    /// What each axiom depends on.
    edges: Vec<Vec<(PredicateId, Sign)>>,
    numbers: FxHashMap<PredicateId, usize>,
    low: FxHashMap<PredicateId, usize>,
    stack: Vec<PredicateId>,
    found: Vec<Vec<PredicateId>>,
}

impl Search<'_> {
    /// Depth is bounded by the number of derived predicates.
    fn visit(&mut self, predicate: PredicateId) {
        let number = self.numbers.len();
        self.numbers.insert(predicate, number);
        self.low.insert(predicate, number);
        self.stack.push(predicate);
        let successors: Vec<PredicateId> = (0..self.axioms.len())
            .filter(|&at| self.axioms[at].predicate == predicate)
            .flat_map(|at| self.edges[at].iter().map(|(on, _)| *on))
            .collect();
        for next in successors {
            let reached = match self.numbers.get(&next) {
                None => {
                    self.visit(next);
                    self.low[&next]
                }
                Some(&number) if self.stack.contains(&next) => number,
                Some(_) => continue,
            };
            let low = self.low[&predicate].min(reached);
            self.low.insert(predicate, low);
        }
        if self.low[&predicate] == number {
            let at =
                self.stack.iter().position(|&p| p == predicate).expect("pushed above, popped below only");
            self.found.push(self.stack.split_off(at));
        }
    }
}
