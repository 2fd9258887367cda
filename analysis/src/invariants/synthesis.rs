//! Candidates, and how they are mended.
//!
//! Problem: the atoms that exclude each other are not declared; they follow from what happens. Idea: a
//! candidate names predicates with some of their arguments as parameters and at most one that is
//! counted: "for each `?x`, how many of `(at ?x _)` and `(in ?x _)` hold". It is an invariant if nothing
//! that happens makes the number grow: each add goes with a delete, in the same instance, of an atom
//! that held just before. A candidate that an add breaks is mended by the predicates that are deleted
//! there. Invariant: whatever is doubtful (adds for all objects) breaks the candidate. Cost: candidates
//! are bounded, and so are the comparisons that they are judged by; where the bound ends the search,
//! what was found stands.
//!
//! Source: Helmert, "Concise finite-domain representations for PDDL planning tasks", AIJ 2009, §5.
//! Deviation: starts and ends of durative actions are happenings of their own, so that a number that
//! falls at the start and grows back at the end is not found. Where two adds of one happening meet only if
//! parameters are equal, Helmert splits the candidate by an inequality; we keep it under the proviso that
//! no such instance is ever applied; a caller that knows the instances decides.

use std::collections::VecDeque;

use pddl::model::Domain;

use super::balance::{Moves, Verdict, judge};
use super::invariant::{Invariant, Member, Proviso};
use crate::happening::Happening;

/// Candidates that are looked at.
const CANDIDATES: usize = 300;
/// Predicates of one candidate.
const PARTS: usize = 6;
/// Comparisons of changes, over all candidates.
const WORK: usize = 400_000;

/// All invariants that are found.
pub fn invariants(domain: &Domain, happenings: &[Happening<'_>]) -> Vec<Invariant> {
    let found = search(domain, happenings, false, &mut |_| true);
    found.into_iter().map(|(invariant, _)| invariant).collect()
}

/// Invariants, each under provisos, found while `go_on` returns `true`. Its argument is the number of comparisons since
/// its last call. What was found before it returned `false` stands.
pub fn conditional_invariants(
    domain: &Domain,
    happenings: &[Happening<'_>],
    go_on: &mut dyn FnMut(usize) -> bool,
) -> Vec<(Invariant, Vec<Proviso>)> {
    search(domain, happenings, true, go_on)
}

fn search(
    domain: &Domain,
    happenings: &[Happening<'_>],
    conditional: bool,
    go_on: &mut dyn FnMut(usize) -> bool,
) -> Vec<(Invariant, Vec<Proviso>)> {
    let moves: Vec<Moves<'_>> = happenings.iter().map(Moves::of).collect();
    // By predicate: what adds it.
    let mut adders: Vec<Vec<usize>> = vec![Vec::new(); domain.predicates.len()];
    for (i, moves) in moves.iter().enumerate() {
        for add in &moves.adds {
            let list = &mut adders[add.atom.predicate.0 as usize];
            if list.last() != Some(&i) {
                list.push(i);
            }
        }
    }
    let mut queue: VecDeque<Invariant> = VecDeque::new();
    for (predicate, declared) in domain.predicates.enumerate().filter(|(_, p)| !p.derived) {
        if adders[predicate.0 as usize].is_empty() {
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
    let mut work = WORK;
    while let Some(candidate) = queue.pop_front() {
        let mut own: Vec<usize> =
            candidate.members.iter().flat_map(|m| &adders[m.predicate.0 as usize]).copied().collect();
        own.sort_unstable();
        own.dedup();
        let mut provisos = Vec::new();
        let taken = conditional.then_some(&mut provisos);
        match judge(domain, &candidate, own.iter().map(|&i| (i, &moves[i])), taken, &mut work, go_on) {
            Verdict::Holds => found.push((candidate, provisos)),
            Verdict::Broken => {}
            Verdict::GivenUp => break,
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
    use pddl::model::Term;

    use super::*;
    use crate::happening::happenings;

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

    fn found(domain: &str) -> Vec<String> {
        let domain = pddl::parse_domain(&pddl::Source::new("domain", domain), &[]).model.expect("correct");
        let happenings = happenings(&domain);
        let member = |m: &Member| {
            let mut arguments = vec!["_".to_owned(); m.parameters.len() + usize::from(m.counted.is_some())];
            m.parameters.iter().enumerate().for_each(|(i, &at)| arguments[at] = i.to_string());
            arguments.insert(0, domain.predicates[m.predicate].name.to_string());
            arguments.join(" ")
        };
        let words = |i: &Invariant| i.members.iter().map(member).collect::<Vec<_>>().join(", ");
        invariants(&domain, &happenings).iter().map(words).collect()
    }

    #[test]
    fn blocks_have_their_known_invariants() {
        let all = found(BLOCKS);
        assert!(all.contains(&"on 0 _, table 0, held 0".to_owned()), "{all:?}");
        assert!(all.contains(&"on _ 0, clear 0, held 0".to_owned()), "{all:?}");
        assert!(all.contains(&"free, held _".to_owned()), "{all:?}");
    }

    #[test]
    fn an_atom_that_is_added_twice_is_one() {
        let all = found(
            "(define (domain d) (:predicates (peg ?x) (hole ?x))
             (:action jump :parameters (?a ?b ?c) :precondition (and (peg ?a) (peg ?b) (hole ?c))
              :effect (and (not (peg ?a)) (not (peg ?b)) (not (hole ?c)) (hole ?a) (hole ?b) (peg ?c))))",
        );
        assert!(all.contains(&"peg 0, hole 0".to_owned()), "{all:?}");
    }

    #[test]
    fn what_breaks_only_where_parameters_are_equal_holds_under_that_proviso() {
        let source = "(define (domain d) (:predicates (open ?x) (in ?x) (out ?x) (next ?x ?y))
             (:action join :parameters (?p ?q) :precondition (and (open ?p) (open ?q) (next ?p ?q))
              :effect (and (not (open ?p)) (not (open ?q)) (in ?p) (out ?q)))
             (:action turn :parameters (?p) :precondition (in ?p)
              :effect (and (not (in ?p)) (out ?p))))";
        let domain = pddl::parse_domain(&pddl::Source::new("domain", source), &[]).model.expect("correct");
        let happenings = happenings(&domain);
        let found = conditional_invariants(&domain, &happenings, &mut |_| true);
        let whole = found.iter().find(|(i, _)| i.members.len() == 3).expect("open, in and out of one place");
        let [proviso] = &whole.1[..] else { panic!("{:?}", whole.1) };
        let variables: Vec<(Term, Term)> = proviso.equal.clone();
        assert_eq!((proviso.happening, variables.len()), (0, 1));
        assert!(invariants(&domain, &happenings).iter().all(|i| i.members.len() < 3));
        let mut asked = 0;
        let none = conditional_invariants(&domain, &happenings, &mut |_| {
            asked += 1;
            false
        });
        assert_eq!((none.len(), asked), (0, 1), "the search ends when the caller wants no more");
    }

    #[test]
    fn what_two_adds_may_meet_in_is_none() {
        let all = found(
            "(define (domain d) (:predicates (at ?x ?y) (far ?x ?y))
             (:action both :parameters (?x ?a ?b ?c) :precondition (at ?x ?a)
              :effect (and (not (at ?x ?a)) (at ?x ?b) (at ?x ?c))))",
        );
        assert!(all.is_empty(), "{all:?}");
    }
}
