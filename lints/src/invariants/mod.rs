//! Sets of atoms of which at most one holds at a time.
//!
//! Problem: two conditions of which the one excludes the other are a mistake that relaxed
//! reachability cannot see. Idea: a candidate names predicates with some of their arguments as
//! parameters and at most one that is counted: "for each `?x`, how many of `(at ?x _)` and
//! `(in ?x _)` hold". It is an invariant if nothing that happens makes the number grow: each add
//! goes with a delete, in the same instance, of an atom that held just before. A candidate that an
//! add breaks is mended by the predicates that are deleted there. Invariant: whatever is doubtful
//! (adds for all objects, adds by the clock) breaks the candidate. Cost: candidates are bounded, each
//! is held against all effects.
//!
//! Source: Helmert, "Concise finite-domain representations for PDDL planning tasks", AIJ 2009, §5.
//! Deviation: starts and ends of durative actions are happenings of their own, so that a number that
//! falls at the start and grows back at the end is not found.

mod balance;
mod instances;

use std::collections::VecDeque;

use pddl::model::{Domain, PredicateId};

use crate::happening::happenings;

pub(crate) use balance::{differ, literals};
pub(crate) use instances::Counts;

use balance::{Moves, Verdict, judge, moves};

/// Candidates that are looked at.
const CANDIDATES: usize = 300;
/// Predicates of one candidate.
const PARTS: usize = 6;

/// A predicate of an invariant.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) struct Member {
    /// Which.
    pub(crate) predicate: PredicateId,
    /// The argument that each parameter is, by position.
    pub(crate) parameters: Vec<usize>,
    /// The argument that is counted.
    pub(crate) counted: Option<usize>,
}

impl Member {
    /// The parameters' values in an atom of the predicate.
    pub(crate) fn instance<T: Copy>(&self, arguments: &[T]) -> Vec<T> {
        self.parameters.iter().map(|&p| arguments[p]).collect()
    }
}

/// No more atoms of one instance hold than held initially.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Invariant {
    /// Sorted by predicate, each at most once.
    pub(crate) members: Vec<Member>,
}

impl Invariant {
    /// The member for a predicate.
    pub(crate) fn member(&self, predicate: PredicateId) -> Option<&Member> {
        self.members.iter().find(|m| m.predicate == predicate)
    }

    /// In words, with these terms for the parameters.
    pub(crate) fn words(&self, domain: &Domain, parameters: &[String]) -> String {
        let atom = |m: &Member| {
            let mut arguments = vec!["_".to_owned(); m.parameters.len() + usize::from(m.counted.is_some())];
            for (&at, name) in m.parameters.iter().zip(parameters) {
                arguments[at].clone_from(name);
            }
            arguments.insert(0, domain.predicates[m.predicate].name.to_string());
            format!("`({})`", arguments.join(" "))
        };
        let atoms: Vec<String> = self.members.iter().map(atom).collect();
        format!("at most one of {} holds at a time", crate::reachability::listed(&atoms))
    }
}

/// All invariants that are found.
pub(crate) fn invariants(domain: &Domain) -> Vec<Invariant> {
    let happenings = happenings(domain);
    let moves: Vec<Moves<'_>> = happenings.iter().map(moves).collect();
    let mut queue: VecDeque<Invariant> = VecDeque::new();
    for (predicate, declared) in domain.predicates.enumerate().filter(|(_, p)| !p.derived) {
        if !moves.iter().any(|m| m.adds.iter().any(|a| a.atom.predicate == predicate)) {
            continue;
        }
        let arity = declared.variables.parameters;
        for counted in std::iter::once(None).chain((0..arity).map(Some)) {
            let parameters = (0..arity).filter(|&p| Some(p) != counted).collect();
            queue.push_back(Invariant { members: vec![Member { predicate, parameters, counted }] });
        }
    }
    let mut seen: Vec<Invariant> = queue.iter().cloned().collect();
    let mut found = Vec::new();
    while let Some(candidate) = queue.pop_front() {
        match judge(domain, &candidate, &moves) {
            Verdict::Holds => found.push(candidate),
            Verdict::Broken => {}
            Verdict::Unbalanced(remedies) => {
                for member in remedies.into_iter().filter(|_| candidate.members.len() < PARTS) {
                    let mut members = candidate.members.clone();
                    members.push(member);
                    members.sort();
                    let next = Invariant { members };
                    if seen.len() < CANDIDATES && !seen.contains(&next) {
                        seen.push(next.clone());
                        queue.push_back(next);
                    }
                }
            }
        }
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::test_support::both;

    const BLOCKS: &str = "(define (domain blocks)
      (:predicates (on ?x ?y) (table ?x) (clear ?x) (free) (held ?x))
      (:action pick :parameters (?x) :precondition (and (clear ?x) (table ?x) (free))
        :effect (and (not (table ?x)) (not (clear ?x)) (not (free)) (held ?x)))
      (:action put :parameters (?x) :precondition (held ?x)
        :effect (and (not (held ?x)) (clear ?x) (free) (table ?x)))
      (:action stack :parameters (?x ?y) :precondition (and (held ?x) (clear ?y))
        :effect (and (not (held ?x)) (not (clear ?y)) (clear ?x) (free) (on ?x ?y)))
      (:action unstack :parameters (?x ?y) :precondition (and (on ?x ?y) (clear ?x) (free))
        :effect (and (held ?x) (clear ?y) (not (clear ?x)) (not (free)) (not (on ?x ?y)))))";

    #[test]
    fn blocks_have_their_known_invariants() {
        let (domain, _) =
            both(BLOCKS, "(define (problem p) (:domain blocks) (:objects a) (:init (free)) (:goal (and)))");
        let all: Vec<String> =
            invariants(&domain).iter().map(|i| i.words(&domain, &["?1".into(), "?2".into()])).collect();
        let all = all.join("\n");
        assert!(all.contains("at most one of `(on ?1 _)`, `(table ?1)` and `(held ?1)` holds"), "{all}");
        assert!(all.contains("at most one of `(free)` and `(held _)` holds"), "{all}");
    }
}
