; A chair can be lit.
(define (domain hall)
  (:requirements :typing)
  (:types lamp chair)
  (:predicates (lit ?x - object))
  (:action switch
    :parameters (?x - lamp)
    :effect (lit ?x)))
