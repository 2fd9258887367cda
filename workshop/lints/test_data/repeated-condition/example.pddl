(define (domain hall)
  (:requirements :typing)
  (:types lamp)
  (:predicates (lit ?x - lamp) (broken ?x - lamp))
  (:action switch
    :parameters (?x - lamp)
    :precondition (and (broken ?x) (broken ?x))
    :effect (lit ?x)))
