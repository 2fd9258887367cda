(define (domain talker)
  (:requirements :typing :negative-preconditions :fluents :durative-actions :agent-rules)
  (:import lab)
  (:durative-action rule
    :parameters (?r - robot ?s - sentence)
    :condition (at start (shall_say ?r ?s))
    :effect (and (at start (not (shall_say ?r ?s))) (at end (said ?r ?s)))))
