(define (domain hall)
  (:requirements :typing)
  (:types lamp - thing room - object lamp - object thing - object)
  (:predicates (lit ?x - lamp) (in ?x - thing ?r - room))
  (:action switch
    :parameters (?x - lamp ?r - room)
    :precondition (in ?x ?r)
    :effect (lit ?x)))
