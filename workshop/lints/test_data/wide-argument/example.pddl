(define (domain hall)
  (:requirements :typing)
  (:types lamp - thing)
  (:predicates (lit ?x - lamp) (here ?x - thing))
  (:action switch
    :parameters (?x - thing)
    :precondition (here ?x)
    :effect (lit ?x)))
