//! U06: parts of the language that are read but that no model holds.

use super::Explanation;

pub(super) const EXPLANATIONS: &[Explanation] = &[Explanation {
    code: "U0601",
    title: "read but not supported",
    meaning: "The file uses a part of PDDL or HDDL that is read, and checked as far as that goes, but that the \
         model does not hold, such as effects that are not certain. The message names it.",
    why: "It is no mistake. Commands that need the meaning of that part say so and exit with 4.",
    wrong: &["\
(define (domain hall)
  (:predicates (lit ?x))
  (:action switch :parameters (?x) :effect (oneof (lit ?x) (not (lit ?x)))))"],
    right: &["\
(define (domain hall)
  (:predicates (lit ?x))
  (:action switch :parameters (?x) :effect (lit ?x)))"],
}];
