(define (domain hall)
  (:requirements :typing :universal-preconditions)
  (:types lamp room)
  (:predicates (lit ?x - lamp) (in ?x - lamp ?r) (any ?x - object))
  (:action switch
    :parameters (?r ?x - lamp ?q)
    :precondition (and (in ?x ?r) (forall (?y) (any ?y)) (any ?q))
    :effect (lit ?x)))
