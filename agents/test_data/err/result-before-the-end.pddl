(define (domain talker)
  (:requirements :typing :negative-preconditions :fluents :durative-actions :agent-rules)
  (:import lab)
  (:durative-action rule
    :parameters (?r - robot ?p - person)
    :condition (at start (shall_ask ?r ?p))
    :results (?s - sentence)
    :effect (and (at end (heard ?r ?s)) (at misheard (heard ?r ?s)))
    :skill (listen ?p)))
