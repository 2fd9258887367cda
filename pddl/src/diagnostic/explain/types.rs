//! E03: wrong numbers and types of arguments and values.

use super::Explanation;

pub(super) const EXPLANATIONS: &[Explanation] = &[
    Explanation {
        code: "E0301",
        title: "wrong number of arguments",
        meaning: "A predicate, function, task or action is given more or fewer arguments than its \
         declaration has.",
        why: "It would be another predicate with the same name. The help shows the declaration.",
        wrong: &["\
(define (domain hall)
  (:requirements :typing)
  (:types lamp)
  (:predicates (lit ?x - lamp))
  (:action switch :parameters (?x - lamp) :effect (lit)))"],
        right: &["\
(define (domain hall)
  (:requirements :typing)
  (:types lamp)
  (:predicates (lit ?x - lamp))
  (:action switch :parameters (?x - lamp) :effect (lit ?x)))"],
    },
    Explanation {
        code: "E0302",
        title: "argument of a wrong type",
        meaning: "An argument can never be of the type that the declaration asks for.",
        why: "The condition could never hold, or the fact could never be used: most often two arguments \
         are swapped.",
        wrong: &["\
(define (domain hall)
  (:requirements :typing)
  (:types lamp room)
  (:predicates (in ?x - lamp ?r - room))
  (:action hang :parameters (?x - lamp ?r - room) :effect (in ?r ?x)))"],
        right: &["\
(define (domain hall)
  (:requirements :typing)
  (:types lamp room)
  (:predicates (in ?x - lamp ?r - room))
  (:action hang :parameters (?x - lamp ?r - room) :effect (in ?x ?r)))"],
    },
    Explanation {
        code: "E0303",
        title: "types with nothing in common",
        meaning: "Two terms are compared, or one is assigned to the other, and nothing can be of both their \
         types.",
        why: "The comparison is always false, and the value never fits.",
        wrong: &["\
(define (domain hall)
  (:requirements :typing :object-fluents)
  (:types lamp room)
  (:functions (place ?x - lamp) - room)
  (:action hang :parameters (?x ?y - lamp) :effect (assign (place ?x) ?y)))"],
        right: &["\
(define (domain hall)
  (:requirements :typing :object-fluents)
  (:types lamp room)
  (:functions (place ?x - lamp) - room)
  (:action hang :parameters (?x - lamp ?y - room) :effect (assign (place ?x) ?y)))"],
    },
    Explanation {
        code: "E0304",
        title: "cyclic types",
        meaning: "A type is its own supertype, directly or through others.",
        why: "All types on the circle would be one and the same.",
        wrong: &["\
(define (domain hall)
  (:requirements :typing)
  (:types lamp - device device - lamp)
  (:predicates (lit ?x - lamp)))"],
        right: &["\
(define (domain hall)
  (:requirements :typing)
  (:types lamp - device)
  (:predicates (lit ?x - lamp)))"],
    },
    Explanation {
        code: "E0305",
        title: "a function of the wrong kind",
        meaning: "A function that yields an object stands where a number is needed, or the other way round.",
        why: "Objects cannot be added or compared by size, and numbers are no objects.",
        wrong: &["\
(define (domain hall)
  (:requirements :typing :fluents)
  (:types lamp room)
  (:functions (place ?x - lamp) - room)
  (:action hang :parameters (?x - lamp) :effect (increase (place ?x) 1)))"],
        right: &["\
(define (domain hall)
  (:requirements :typing :fluents)
  (:types lamp room)
  (:functions (height ?x - lamp) - number)
  (:action hang :parameters (?x - lamp) :effect (increase (height ?x) 1)))"],
    },
    Explanation {
        code: "E0306",
        title: "an effect on a derived predicate",
        meaning: "An action sets or deletes a predicate that a `(:derived …)` defines.",
        why: "A derived predicate holds when its condition does and at no other time. Let the action \
         change what the condition is about.",
        wrong: &["\
(define (domain hall)
  (:requirements :derived-predicates)
  (:predicates (lit ?x) (bright))
  (:derived (bright) (exists (?x) (lit ?x)))
  (:action switch :parameters (?x) :effect (bright)))"],
        right: &["\
(define (domain hall)
  (:requirements :derived-predicates)
  (:predicates (lit ?x) (bright))
  (:derived (bright) (exists (?x) (lit ?x)))
  (:action switch :parameters (?x) :effect (lit ?x)))"],
    },
    Explanation {
        code: "E0307",
        title: "a function where only objects can be arguments",
        meaning: "A function to objects is an argument in an initial state, of a task, of a skill or in a metric.",
        why: "There its value would have to be known before anything is: name the object. In conditions and \
         effects functions can be arguments.",
        wrong: &[
            "\
(define (domain hall)
  (:requirements :object-fluents)
  (:types lamp)
  (:predicates (lit ?x - lamp))
  (:functions (nearest) - lamp))",
            "\
(define (problem evening)
  (:domain hall)
  (:objects red - lamp)
  (:init (= (nearest) red) (lit (nearest)))
  (:goal (lit red)))",
        ],
        right: &[
            "\
(define (domain hall)
  (:requirements :object-fluents)
  (:types lamp)
  (:predicates (lit ?x - lamp))
  (:functions (nearest) - lamp))",
            "\
(define (problem evening)
  (:domain hall)
  (:objects red - lamp)
  (:init (= (nearest) red) (lit red))
  (:goal (lit (nearest))))",
        ],
    },
];
