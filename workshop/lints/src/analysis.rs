//! What the lints of reachability share: computed once for a domain or a problem, when the first lint asks.

use std::rc::Rc;

use analysis::happening::happenings;
use analysis::intervals::Hulls;
use analysis::invariants::{Counts, Invariant, invariants};
use analysis::reachability::{Summary, Wording};
use pddl::model::{Domain, DurativeAction, Problem};

use crate::coverage::{all_is_seen, all_of_problem_is_seen};

/// Atoms of which at most one holds at a time.
pub(crate) struct Exclusion {
    /// The invariant.
    pub(crate) invariant: Invariant,
    /// The number of its atoms in the initial state.
    pub(crate) counts: Counts,
}

/// What is known of a domain, or of a problem.
pub(crate) struct Analysis<'a> {
    /// The values that numeric fluents can take.
    pub(crate) hulls: Rc<Hulls>,
    /// Which atoms exclude each other.
    pub(crate) exclusions: Vec<Exclusion>,
    /// What never happens; empty where the language is not covered or the budget does not suffice.
    pub(crate) never: Summary<'a>,
}

impl<'a> Analysis<'a> {
    /// Of a domain with or without a problem whose models hold all that the texts say.
    pub(crate) fn new(wording: &Wording<'a>) -> Self {
        let (domain, problem) = (wording.domain, wording.problem);
        let hulls = Rc::new(Hulls::new(domain, problem));
        let is_covered = all_is_seen(domain) && problem.is_none_or(all_of_problem_is_seen);
        let exclusions = problem.filter(|_| is_covered).map(|problem| exclusions(domain, problem));
        let never = is_covered.then(|| Summary::new(wording, &hulls)).flatten();
        Self { hulls, exclusions: exclusions.unwrap_or_default(), never: never.unwrap_or_default() }
    }
}

fn exclusions(domain: &Domain, problem: &Problem) -> Vec<Exclusion> {
    // The happening of a rule's outcome, and of an effect that depends on another time, lacks some of its conditions.
    let elsewhere = |a: &DurativeAction| a.rule.is_some() || a.effects.iter().any(|e| !e.given.is_empty());
    if domain.durative_actions.iter().any(elsewhere) {
        return Vec::new();
    }
    let found = invariants(domain, &happenings(domain)).into_iter();
    let counted = |invariant| {
        let counts = Counts::new(&invariant, problem)?;
        Some(Exclusion { invariant, counts })
    };
    found.filter_map(counted).collect()
}
