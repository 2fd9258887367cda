//! U06: parts of the language that are read but that no model holds.

use super::Explanation;

pub(super) const EXPLANATIONS: &[Explanation] = &[Explanation {
    code: "U0601",
    title: "read but not supported",
    meaning: "The file uses a part of PDDL or HDDL that is read, and checked as far as that goes, but \
         that no planner or validator of ours knows: preferences, trajectory constraints, timed \
         initial literals, continuous effects, processes and events are some. The message names it.",
    why: "It is no mistake. Commands that need the meaning of that part say so and exit with 4.",
    wrong: &[
        "\
(define (domain hall)
  (:predicates (lit)))",
        "\
(define (problem evening)
  (:domain hall)
  (:init (at 5 (lit)))
  (:goal (lit)))",
    ],
    right: &[
        "\
(define (domain hall)
  (:predicates (lit)))",
        "\
(define (problem evening)
  (:domain hall)
  (:init (lit))
  (:goal (lit)))",
    ],
}];
