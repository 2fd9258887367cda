//! E02: names that are declared too often, or differently.

use super::Explanation;

pub(super) const EXPLANATIONS: &[Explanation] = &[
    Explanation {
        code: "E0220",
        title: "declared twice",
        meaning: "A name is declared a second time, in another way or where one declaration is allowed.",
        why: "Nothing says which of them counts.",
        wrong: &["\
(define (domain hall)
  (:requirements :typing)
  (:types lamp)
  (:predicates (lit ?x - lamp))
  (:action switch :parameters (?x - lamp) :effect (lit ?x))
  (:action switch :parameters (?x - lamp) :effect (not (lit ?x))))"],
        right: &["\
(define (domain hall)
  (:requirements :typing)
  (:types lamp)
  (:predicates (lit ?x - lamp))
  (:action switch :parameters (?x - lamp) :effect (lit ?x))
  (:action switch-off :parameters (?x - lamp) :effect (not (lit ?x))))"],
    },
    Explanation {
        code: "E0221",
        title: "declared differently in an imported domain",
        meaning: "A name has another declaration in a domain that is imported.",
        why: "One name would mean two things in one graph. Take the imported declaration, or another \
         name.",
        wrong: &[
            "\
(define (domain vocabulary)
  (:requirements :typing :vocabulary)
  (:types robot state)
  (:predicates (is ?r - robot ?s - state))
  (:writes speech is))",
            "\
(define (domain rules)
  (:requirements :typing)
  (:import vocabulary)
  (:predicates (is ?r - robot)))",
        ],
        right: &[
            "\
(define (domain vocabulary)
  (:requirements :typing :vocabulary)
  (:types robot state)
  (:predicates (is ?r - robot ?s - state))
  (:writes speech is))",
            "\
(define (domain rules)
  (:requirements :typing)
  (:import vocabulary)
  (:predicates (silent ?r - robot)))",
        ],
    },
    Explanation {
        code: "W0222",
        title: "declared twice in the same way",
        meaning: "The same declaration stands twice.",
        why: "It means the same once. Perhaps the second was to be changed after it was copied.",
        wrong: &["\
(define (domain hall)
  (:requirements :typing)
  (:types lamp)
  (:predicates (lit ?x - lamp) (lit ?x - lamp))
  (:action switch :parameters (?x - lamp) :effect (lit ?x)))"],
        right: &["\
(define (domain hall)
  (:requirements :typing)
  (:types lamp)
  (:predicates (lit ?x - lamp))
  (:action switch :parameters (?x - lamp) :effect (lit ?x)))"],
    },
    Explanation {
        code: "W0223",
        title: "a problem of another domain",
        meaning: "The problem names another domain in `(:domain …)` than the one it is read with.",
        why: "The pair may not belong together. Many collections of problems get this wrong, so it is no \
         error.",
        wrong: &[
            "\
(define (domain hall)
  (:requirements :typing)
  (:types lamp)
  (:predicates (lit ?x - lamp))
  (:action switch :parameters (?x - lamp) :effect (lit ?x)))",
            "\
(define (problem evening)
  (:domain cellar)
  (:objects left right - lamp)
  (:init (lit left))
  (:goal (lit right)))",
        ],
        right: &[
            "\
(define (domain hall)
  (:requirements :typing)
  (:types lamp)
  (:predicates (lit ?x - lamp))
  (:action switch :parameters (?x - lamp) :effect (lit ?x)))",
            "\
(define (problem evening)
  (:domain hall)
  (:objects left right - lamp)
  (:init (lit left))
  (:goal (lit right)))",
        ],
    },
    Explanation {
        code: "W0224",
        title: "an object of several types",
        meaning: "An object is declared twice, with different types: it is of both.",
        why: "Seldom meant, and other tools take the last type only. Declare it once, with `(either …)` \
         if it is meant.",
        wrong: &[
            "\
(define (domain hall)
  (:requirements :typing)
  (:types lamp door)
  (:predicates (lit ?x - lamp))
  (:action switch :parameters (?x - lamp) :effect (lit ?x)))",
            "\
(define (problem evening)
  (:domain hall)
  (:objects left right - lamp left - door)
  (:init (lit left))
  (:goal (lit right)))",
        ],
        right: &[
            "\
(define (domain hall)
  (:requirements :typing)
  (:types lamp)
  (:predicates (lit ?x - lamp))
  (:action switch :parameters (?x - lamp) :effect (lit ?x)))",
            "\
(define (problem evening)
  (:domain hall)
  (:objects left right - lamp)
  (:init (lit left))
  (:goal (lit right)))",
        ],
    },
];
