//! Derived predicates.
//!
//! Axioms are sorted into strata. A derived predicate may depend on itself through positive atoms, and negatively
//! only on predicates of lower strata. A domain whose axioms cannot be stratified has no meaning; it is refused with
//! the axiom that closes the cycle.
//!
//! Problem: a plan of a thousand steps queries derived atoms a thousand times, and a step changes next to nothing.
//! Idea: derived predicates that depend on one another form a *component*, the least fixpoint of its rules over the
//! components below it. A condition needs only the components that it reads, directly or indirectly, and a component
//! is updated only if one of its inputs changed since (`update`). Its rules are axioms with their disjunctions split
//! (`rule`). Invariant: after [`Strata::derive_needed`] the requested relations equal a derivation from scratch.
//!
//! Cost: one comparison per input if no input changed, else the cost of `update`.
//!
//! Source: Thiébaux, Hoffmann & Nebel, "In defense of PDDL axioms", AIJ 2005, §2 (stratification).

mod rule;
#[cfg(test)]
mod tests;
mod update;

use crate::reads::each_predicate;
use crate::relation::Moment;
use crate::state::State;
use crate::universe::Universe;
use crate::verdict::IllFormed;
use pddl::model::{Condition, Domain, Idx, IndexVec, PredicateId};
use petgraph::graph::{DiGraph, NodeIndex};
use rule::{Rule, World};
use update::Component;

/// The components that something reads, each after those below it.
#[derive(Clone, Debug, Default)]
pub(crate) struct Needs(Vec<usize>);

impl Needs {
    /// Whether no component is needed.
    pub(crate) fn are_none(&self) -> bool {
        self.0.is_empty()
    }
}

/// The axioms by component, and which predicates they derive.
#[derive(Clone, Debug)]
pub(crate) struct Strata {
    /// Each component comes after those that it reads.
    components: Vec<Component>,
    /// By predicate: its component and all below, in order; empty if it is not derived.
    below: IndexVec<PredicateId, Vec<usize>>,
}

impl Strata {
    pub(crate) fn new(domain: &Domain) -> Result<Self, IllFormed> {
        let mut derived: IndexVec<PredicateId, bool> = domain.predicates.iter().map(|_| false).collect();
        for axiom in &domain.axioms {
            derived[axiom.predicate] = true;
        }
        stratify(domain, &derived)?;
        let mut graph = DiGraph::<(), ()>::with_capacity(domain.predicates.len(), domain.axioms.len());
        let nodes: IndexVec<PredicateId, NodeIndex> =
            domain.predicates.iter().map(|_| graph.add_node(())).collect();
        for axiom in &domain.axioms {
            each_predicate(&axiom.body, true, &mut |predicate, _| {
                if derived[predicate] {
                    graph.update_edge(nodes[axiom.predicate], nodes[predicate], ());
                }
            });
        }
        let mut strata =
            Self { components: Vec::new(), below: domain.predicates.iter().map(|_| Vec::new()).collect() };
        // Edges lead to the predicates that are read, so these come first.
        for circle in petgraph::algo::tarjan_scc(&graph) {
            let own: Vec<_> = circle.iter().map(|node| PredicateId::from_index(node.index())).collect();
            if own.iter().all(|&predicate| derived[predicate]) {
                strata.push(domain, own);
            }
        }
        Ok(strata)
    }

    fn push(&mut self, domain: &Domain, mut own: Vec<PredicateId>) {
        own.sort_unstable();
        let axioms = domain.axioms.iter().enumerate().filter(|(_, axiom)| own.contains(&axiom.predicate));
        let rules: Vec<Rule> = axioms.flat_map(|(index, axiom)| Rule::all(index, axiom)).collect();
        let component = Component::new(own, rules, |predicate| self.derives(predicate));
        let mut below: Vec<usize> =
            component.below().flat_map(|predicate| self.below[predicate].iter().copied()).collect();
        below.push(self.components.len());
        below.sort_unstable();
        below.dedup();
        for &predicate in component.own() {
            self.below[predicate].clone_from(&below);
        }
        self.components.push(component);
    }

    pub(crate) fn derives(&self, predicate: PredicateId) -> bool {
        !self.below[predicate].is_empty()
    }

    /// The components that conditions read.
    pub(crate) fn needs<'c>(&self, conditions: impl IntoIterator<Item = &'c Condition>) -> Needs {
        let mut needs = Needs::default();
        for condition in conditions {
            each_predicate(condition, true, &mut |predicate, _| needs.0.extend(&self.below[predicate]));
        }
        needs.0.sort_unstable();
        needs.0.dedup();
        needs
    }

    /// Updates the derived part of `state`.
    pub(crate) fn derive(&self, domain: &Domain, universe: &Universe, state: &mut State, now: Moment) {
        self.derive_each(0..self.components.len(), World { domain, universe }, state, now);
    }

    /// Updates the needed components.
    pub(crate) fn derive_needed(
        &self,
        needs: &Needs,
        domain: &Domain,
        universe: &Universe,
        state: &mut State,
        now: Moment,
    ) {
        self.derive_each(needs.0.iter().copied(), World { domain, universe }, state, now);
    }

    fn derive_each(
        &self,
        components: impl Iterator<Item = usize>,
        world: World<'_>,
        state: &mut State,
        now: Moment,
    ) {
        if state.lag.0.len() != self.components.len() {
            state.lag.0 = vec![None; self.components.len()];
        }
        for index in components {
            let component = &self.components[index];
            let seen = state.lag.0[index].take();
            let seen = match seen {
                Some(seen) if component.is_current(&seen, state) => seen,
                seen => {
                    component.update(seen.as_ref(), world, state, now);
                    component.see(state)
                }
            };
            state.lag.0[index] = Some(seen);
        }
    }
}

/// Checks that no derived predicate depends on its own negation.
fn stratify(domain: &Domain, derived: &IndexVec<PredicateId, bool>) -> Result<(), IllFormed> {
    let mut level: IndexVec<PredicateId, usize> = domain.predicates.iter().map(|_| 0).collect();
    loop {
        let mut raised = None;
        for axiom in &domain.axioms {
            let mut least = level[axiom.predicate];
            each_predicate(&axiom.body, true, &mut |predicate, positive| {
                if derived[predicate] {
                    least = least.max(level[predicate] + usize::from(!positive));
                }
            });
            if least > level[axiom.predicate] {
                level[axiom.predicate] = least;
                raised = Some((axiom, least));
            }
        }
        match raised {
            None => return Ok(()),
            // Without a negative cycle, the level of a predicate is at most the number of
            // predicates.
            Some((axiom, least)) if least > domain.predicates.len() => {
                return Err(IllFormed::Unstratified { predicate: axiom.predicate, span: axiom.span });
            }
            Some(_) => {}
        }
    }
}
