(define (domain hall)
  (:requirements :typing)
  (:types lamp)
  (:predicates (lit ?x - lamp) (broken ?x - lamp))
  (:action switch
    :parameters (?x - lamp)
    :precondition (broken ?x)
    :effect (and (lit ?x) (lit ?x))))
