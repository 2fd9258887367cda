(define (domain talker)
  (:requirements :typing :negative-preconditions :fluents :durative-actions :agent-rules)
  (:import lab)
  (:durative-action rule
    :parameters (?r - robot ?s - sentence)
    :condition (at start (shall_say ?r ?s))
    :effect (at start (said ?r ?s))))
