; The channel is asked for, taken and given back: nobody else can use it at the same time.
(define (domain hall)
  (:requirements :typing)
  (:types lamp)
  (:predicates (lit ?x - lamp) (free) (clear ?x - lamp))
  (:action switch
    :parameters (?x - lamp)
    :precondition (and (free) (clear ?x))
    :effect (and (lit ?x) (not (free)) (free) (not (clear ?x)) (clear ?x)))
  (:action cover
    :parameters (?x - lamp)
    :precondition (clear ?x)
    :effect (not (clear ?x))))
