//! E05: times, outcomes, and what needs a requirement.

use super::Explanation;

pub(super) const EXPLANATIONS: &[Explanation] = &[
    Explanation {
        code: "E0501",
        title: "unknown time",
        meaning: "`(at …)` in a durative action names neither `start` nor `end`. In a domain with `:agent- \
         rules` an effect can also have an outcome, such as `(at timeout …)`.",
        why: "A condition or an effect without a time would never be looked at.",
        wrong: &["\
(define (domain hall)
  (:requirements :durative-actions)
  (:predicates (lit))
  (:durative-action switch
    :parameters ()
    :duration (= ?duration 5)
    :condition (at strat (not (lit)))
    :effect (at end (lit))))"],
        right: &["\
(define (domain hall)
  (:requirements :durative-actions)
  (:predicates (lit))
  (:durative-action switch
    :parameters ()
    :duration (= ?duration 5)
    :condition (at start (not (lit)))
    :effect (at end (lit))))"],
    },
    Explanation {
        code: "E0502",
        title: "an outcome in a condition",
        meaning: "A condition of a rule has an outcome such as `abort` or `timeout` for its time.",
        why: "Outcomes are how a rule ends; a condition is about its start or the time meanwhile.",
        wrong: &["\
(define (domain voice)
  (:requirements :durative-actions :agent-rules)
  (:predicates (speaking))
  (:durative-action say
    :parameters ()
    :condition (at abort (speaking))
    :effect (at abort (not (speaking)))
    :skill (say)))"],
        right: &["\
(define (domain voice)
  (:requirements :durative-actions :agent-rules)
  (:predicates (speaking))
  (:durative-action say
    :parameters ()
    :condition (over all (speaking))
    :effect (at abort (not (speaking)))
    :skill (say)))"],
    },
    Explanation {
        code: "E0503",
        title: "a requirement is missing",
        meaning: "A section or key that is no PDDL stands in a domain that does not declare the requirement \
         it belongs to.",
        why: "Standard PDDL has no such part: the requirement tells other tools, and readers, that this \
         file goes beyond it.",
        wrong: &["\
(define (domain voice)
  (:requirements :durative-actions)
  (:predicates (speaking))
  (:durative-action say
    :parameters ()
    :condition (over all (speaking))
    :effect (at end (not (speaking)))
    :skill (say)))"],
        right: &["\
(define (domain voice)
  (:requirements :durative-actions :agent-rules)
  (:predicates (speaking))
  (:durative-action say
    :parameters ()
    :condition (over all (speaking))
    :effect (at abort (not (speaking)))
    :skill (say)))"],
    },
    Explanation {
        code: "E0504",
        title: "a negative time",
        meaning: "A step of a plan starts before the time 0, or takes less than no time; or the time of a timed initial \
         literal or of a constraint is negative.",
        why: "The initial state holds at time 0, and there is nothing before it.",
        wrong: &[
            "\
(define (domain hall)
  (:requirements :durative-actions)
  (:predicates (lit))
  (:durative-action switch
    :parameters ()
    :duration (= ?duration 5)
    :condition (and)
    :effect (at end (lit))))",
            "\
(define (problem evening)
  (:domain hall)
  (:init)
  (:goal (lit)))",
            "-1: (switch) [5]",
        ],
        right: &[
            "\
(define (domain hall)
  (:requirements :durative-actions)
  (:predicates (lit))
  (:durative-action switch
    :parameters ()
    :duration (= ?duration 5)
    :condition (and)
    :effect (at end (lit))))",
            "\
(define (problem evening)
  (:domain hall)
  (:init)
  (:goal (lit)))",
            "1: (switch) [5]",
        ],
    },
    Explanation {
        code: "E0505",
        title: "steps out of order",
        meaning: "The steps of a sequential plan are numbered, and a lower number stands behind a higher one.",
        why: "Steps are taken in the order of the file. Numbers that say otherwise leave open which of the two \
         is meant.",
        wrong: &[
            "\
(define (domain hall)
  (:predicates (lit))
  (:action switch :effect (lit))
  (:action leave :effect (not (lit))))",
            "\
(define (problem evening)
  (:domain hall)
  (:init)
  (:goal (lit)))",
            "1: (switch)
0: (leave)",
        ],
        right: &[
            "\
(define (domain hall)
  (:predicates (lit))
  (:action switch :effect (lit))
  (:action leave :effect (not (lit))))",
            "\
(define (problem evening)
  (:domain hall)
  (:init)
  (:goal (lit)))",
            "0: (leave)
1: (switch)",
        ],
    },
];
