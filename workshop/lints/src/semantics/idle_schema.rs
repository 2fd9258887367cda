//! A part of a domain that the problems at hand have no data for.

use pddl::Explanation;

use crate::finding::Findings;
use crate::lint::Check;
use crate::reachability::Nature;
use crate::view::ProblemView;
use crate::{Level, Lint};

use super::dead::{Wording, report};

pub(crate) static LINT: Lint = Lint {
    name: "idle-schema",
    level: Level::Pedantic,
    explanation: Explanation {
        code: "W0856",
        title: "no problem has data for it",
        meaning: "An action, a method, an axiom or a conditional effect can never come into play in any problem \
         that was looked at, because they lack objects, or facts that nothing changes.",
        why: "A domain may well do more than its problems need. But where it was meant to be used, `:init` lacks \
         facts or has them with their arguments the other way round.",
        wrong: &[
            "\
(define (domain hall)
  (:requirements :typing)
  (:types lamp)
  (:predicates (lit ?l - lamp) (left-of ?a ?b - lamp))
  (:action switch
    :parameters (?l - lamp)
    :effect (lit ?l))
  (:action switch-between
    :parameters (?l ?a ?b - lamp)
    :precondition (and (left-of ?a ?l) (left-of ?l ?b))
    :effect (lit ?l)))",
            "\
(define (problem evening)
  (:domain hall)
  (:objects a b - lamp)
  (:init (left-of a b))
  (:goal (and (lit a) (lit b))))",
        ],
        right: &[
            "\
(define (domain hall)
  (:requirements :typing)
  (:types lamp)
  (:predicates (lit ?l - lamp) (left-of ?a ?b - lamp))
  (:action switch
    :parameters (?l - lamp)
    :effect (lit ?l))
  (:action switch-between
    :parameters (?l ?a ?b - lamp)
    :precondition (and (left-of ?a ?l) (left-of ?l ?b))
    :effect (lit ?l)))",
            "\
(define (problem evening)
  (:domain hall)
  (:objects a b c - lamp)
  (:init (left-of a b) (left-of b c))
  (:goal (and (lit a) (lit b) (lit c))))",
        ],
    },
    checks: &[Check::Problem(check)],
};

static WORDING: Wording = Wording { lint: &LINT, about: |_| true, verdict: "has no data in any problem" };

fn check(view: &ProblemView<'_, '_>, found: &mut Findings) {
    report(view.analysis(), &view.words(), &WORDING, &|dead| dead.nature == Nature::Data, found);
}
