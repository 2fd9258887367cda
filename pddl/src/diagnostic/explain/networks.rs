//! E04: task networks.

use super::Explanation;

pub(super) const EXPLANATIONS: &[Explanation] = &[Explanation {
    code: "E0401",
    title: "cyclic ordering",
    meaning: "The subtasks of a method wait for each other in a circle.",
    why: "None of them could ever start, so the method could never succeed.",
    wrong: &["\
(define (domain hall)
  (:requirements :hierarchy)
  (:predicates (lit))
  (:task brighten :parameters ())
  (:action switch :effect (lit))
  (:method by-hand
    :parameters ()
    :task (brighten)
    :subtasks (and (first (switch)) (second (switch)))
    :ordering (and (< first second) (< second first))))"],
    right: &["\
(define (domain hall)
  (:requirements :hierarchy)
  (:predicates (lit))
  (:task brighten :parameters ())
  (:action switch :effect (lit))
  (:method by-hand
    :parameters ()
    :task (brighten)
    :subtasks (and (first (switch)) (second (switch)))
    :ordering (< first second)))"],
}];
