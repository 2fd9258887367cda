(define (domain nobody)
  (:requirements :typing :negative-preconditions :fluents :durative-actions :agent-rules)
  (:import lab)
  (:durative-action rule
    :parameters (?r - robot ?s - sentence)
    :condition (over all (shall_say ?r ?s))
    :effect (at end (said ?r ?s))
    :skill (say ?r ?s)))
