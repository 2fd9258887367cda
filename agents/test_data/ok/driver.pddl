; Its own beginning may break one part of its condition over all; the other part is about where things are.
(define (domain driver)
  (:requirements :typing :fluents :numeric-fluents :negative-preconditions :disjunctive-preconditions
                 :durative-actions :agent-rules)
  (:import lab)

  (:durative-action wait
    :parameters (?r - robot ?p - person)
    :condition (and
      (at start (shall_ask ?r ?p))
      (over all (< (distance ?r ?p) 2))
      (over all (not (and (is ?r quiet) (waits_for ?r ?p)))))
    :effect (and
      (at start (waits_for ?r ?p))
      (at end (not (shall_ask ?r ?p)))
      (at end (not (waits_for ?r ?p)))
      (at abort (not (waits_for ?r ?p))))
    :skill (say ?p ?p)))
