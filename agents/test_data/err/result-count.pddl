(define (domain talker)
  (:requirements :typing :negative-preconditions :fluents :durative-actions :agent-rules)
  (:import lab)
  (:durative-action rule
    :parameters (?r - robot ?p - person)
    :condition (at start (shall_ask ?r ?p))
    :effect (at end (not (shall_ask ?r ?p)))
    :skill (listen ?p)))
