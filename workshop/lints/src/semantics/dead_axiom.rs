//! An axiom whose body never holds.

use pddl::Explanation;

use crate::lint::Check;
use crate::reachability::Schema;
use crate::{Level, Lint};

use super::dead::{Wording, in_domain, in_problem};

pub(crate) static LINT: Lint = Lint {
    name: "dead-axiom",
    level: Level::Default,
    explanation: Explanation {
        code: "W0851",
        title: "axiom never derives anything",
        meaning: "The body of an axiom holds in no reachable state, whatever the problem: mostly a recursion that \
         nothing starts.",
        why: "A derived predicate is false unless some axiom derives it. If every axiom of it needs it already, \
         it is false for ever, and so is all that builds on it.",
        wrong: &["\
(define (domain hall)
  (:requirements :adl :derived-predicates)
  (:types place)
  (:predicates
    (road ?a ?b - place)
    (linked ?a ?b - place))
  (:derived (linked ?a ?b - place)
    (exists (?c - place)
      (and (road ?a ?c) (linked ?c ?b)))))"],
        right: &["\
(define (domain hall)
  (:requirements :adl :derived-predicates)
  (:types place)
  (:predicates
    (road ?a ?b - place)
    (linked ?a ?b - place))
  (:derived (linked ?a ?b - place)
    (or (road ?a ?b)
        (exists (?c - place)
          (and (road ?a ?c) (linked ?c ?b))))))"],
    },
    checks: &[
        Check::Domain(|view, found| in_domain(view, &WORDING, found)),
        Check::Problem(|view, found| in_problem(view, &WORDING, found)),
    ],
};

static WORDING: Wording = Wording {
    lint: &LINT,
    about: |o| matches!(o.schema, Schema::Axiom(_)),
    verdict: "never derives anything",
};
