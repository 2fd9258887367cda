//! What follows from a state by the axioms.
//!
//! Axioms are sorted into strata: a derived predicate may depend on itself through positive atoms, and
//! negatively only on predicates of lower strata. Each stratum is a least fixpoint, found bottom-up; an
//! axiom is evaluated again only while something that it reads still grows. A domain whose axioms cannot
//! be stratified has no meaning and is refused with the axiom that closes the circle.
//!
//! Cost: rounds × axioms of a stratum, each the join of its body (`solve`). Derived only when a
//! condition reads a derived predicate and a fact changed since.
//!
//! Source: Thiébaux, Hoffmann & Nebel, "In defense of PDDL axioms", AIJ 2005, §2 (stratification).

use crate::condition::Strictness;
use crate::scene::{Binding, Clock, Scene};
use crate::state::{Moment, State};
use crate::universe::Universe;
use crate::verdict::IllFormed;
use pddl::model::{Axiom, Condition, ConditionKind, Domain, Idx, ObjectId, PredicateId};
use std::ops::ControlFlow;

/// The atoms of a condition: their predicate, and whether it is read positively.
pub(crate) fn each_predicate(
    condition: &Condition,
    positive: bool,
    visit: &mut dyn FnMut(PredicateId, bool),
) {
    match &condition.kind {
        ConditionKind::And(parts) | ConditionKind::Or(parts) => {
            for part in parts {
                each_predicate(part, positive, visit);
            }
        }
        ConditionKind::Not(part) => each_predicate(part, !positive, visit),
        ConditionKind::Imply(if_, then) => {
            each_predicate(if_, !positive, visit);
            each_predicate(then, positive, visit);
        }
        ConditionKind::Exists(_, part) | ConditionKind::Forall(_, part) => {
            each_predicate(part, positive, visit);
        }
        ConditionKind::Atom(atom) => visit(atom.predicate, positive),
        ConditionKind::HasType(..)
        | ConditionKind::Same(..)
        | ConditionKind::Compare(..)
        | ConditionKind::FluentIs(..) => {}
    }
}

/// The axioms by stratum, and which predicates they derive.
#[derive(Clone, Debug)]
pub(crate) struct Strata {
    /// Positions in the domain's axioms, lowest stratum first.
    levels: Vec<Vec<usize>>,
    derived: Vec<bool>,
}

impl Strata {
    pub(crate) fn new(domain: &Domain) -> Result<Self, IllFormed> {
        let mut derived = vec![false; domain.predicates.len()];
        for axiom in &domain.axioms {
            derived[axiom.predicate.index()] = true;
        }
        let mut level = vec![0_usize; domain.predicates.len()];
        loop {
            let mut raised = None;
            for axiom in &domain.axioms {
                let mut least = level[axiom.predicate.index()];
                each_predicate(&axiom.body, true, &mut |predicate, positive| {
                    if derived[predicate.index()] {
                        least = least.max(level[predicate.index()] + usize::from(!positive));
                    }
                });
                if least > level[axiom.predicate.index()] {
                    level[axiom.predicate.index()] = least;
                    raised = Some((axiom, least));
                }
            }
            match raised {
                None => break,
                // Without a negative circle no predicate stands above as many others as there are.
                Some((axiom, least)) if least > domain.predicates.len() => {
                    return Err(IllFormed::Unstratified { predicate: axiom.predicate, span: axiom.span });
                }
                Some(_) => {}
            }
        }
        let mut levels = vec![Vec::new(); level.iter().max().map_or(0, |most| most + 1)];
        for (index, axiom) in domain.axioms.iter().enumerate() {
            levels[level[axiom.predicate.index()]].push(index);
        }
        Ok(Self { levels, derived })
    }

    pub(crate) fn derives(&self, predicate: PredicateId) -> bool {
        self.derived[predicate.index()]
    }

    pub(crate) fn reads_derived(&self, condition: &Condition) -> bool {
        let mut reads = false;
        each_predicate(condition, true, &mut |predicate, _| reads |= self.derives(predicate));
        reads
    }

    /// Brings the derived part of `state` up to date.
    pub(crate) fn derive(&self, domain: &Domain, universe: &Universe, state: &mut State, now: Moment) {
        if !state.stale {
            return;
        }
        for (predicate, _) in domain.predicates.enumerate().filter(|&(p, _)| self.derives(p)) {
            state.derived[predicate].clear();
        }
        for level in &self.levels {
            let axioms: Vec<&Axiom> = level.iter().map(|&index| &domain.axioms[index]).collect();
            let mut grown: Option<Vec<PredicateId>> = None;
            loop {
                let mut growing = Vec::new();
                for axiom in &axioms {
                    if grown.as_ref().is_some_and(|grown| !reads_any(&axiom.body, grown)) {
                        continue;
                    }
                    let heads = consequences(axiom, universe, state);
                    let arity = axiom.variables.parameters;
                    let relation = &mut state.derived[axiom.predicate];
                    let mut new = false;
                    if arity == 0 {
                        new |= heads.is_some() && relation.add(&[], now);
                    } else {
                        for head in heads.unwrap_or_default().chunks_exact(arity) {
                            new |= relation.add(head, now);
                        }
                    }
                    if new && !growing.contains(&axiom.predicate) {
                        growing.push(axiom.predicate);
                    }
                }
                if growing.is_empty() {
                    break;
                }
                grown = Some(growing);
            }
        }
        state.stale = false;
    }
}

fn reads_any(body: &Condition, predicates: &[PredicateId]) -> bool {
    let mut reads = false;
    each_predicate(body, true, &mut |predicate, _| reads |= predicates.contains(&predicate));
    reads
}

/// The head's arguments, one tuple after the other; `None` if the body holds for none.
fn consequences(axiom: &Axiom, universe: &Universe, state: &State) -> Option<Vec<ObjectId>> {
    let scene = Scene { universe, state, variables: &axiom.variables, clock: Clock::steps(0) };
    let mut binding = Binding::new(&axiom.variables, &[]);
    if axiom.variables.parameters == 0 {
        return scene.holds(&axiom.body, &mut binding).then(Vec::new);
    }
    let parameters: Vec<_> = axiom.variables.parameter_ids().collect();
    let mut heads = Vec::new();
    let flow = scene.each_binding(
        &parameters,
        &[(&axiom.body, true)],
        Strictness::Certain,
        &mut binding,
        &mut |binding| {
            heads.extend(parameters.iter().filter_map(|&p| binding.get(p)));
            ControlFlow::Continue(())
        },
    );
    debug_assert!(flow.is_continue());
    (!heads.is_empty()).then_some(heads)
}
