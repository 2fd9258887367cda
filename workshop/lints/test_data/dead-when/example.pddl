(define (domain hall)
  (:requirements :typing :conditional-effects :negative-preconditions)
  (:types lamp)
  (:predicates (lit ?x - lamp) (broken ?x - lamp))
  (:action switch
    :parameters (?x - lamp)
    :precondition (not (broken ?x))
    :effect (when (broken ?x) (lit ?x))))
