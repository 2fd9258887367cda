(define (domain talker)
  (:requirements :typing :negative-preconditions :fluents :durative-actions :agent-rules)
  (:import lab)
  (:predicates (odd ?r - robot))
  (:durative-action rule
    :parameters (?r - robot)
    :condition (at start (odd ?r))
    :effect (at end (is_not ?r speaking))
    :skill (await-loss)))
