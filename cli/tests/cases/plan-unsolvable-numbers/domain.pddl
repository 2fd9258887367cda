(define (domain tank)
  (:requirements :typing :numeric-fluents)
  (:types car)
  (:predicates (there ?c - car))
  (:functions (fuel ?c - car) (capacity ?c - car))
  (:action fill
    :parameters (?c - car)
    :precondition (<= (+ (fuel ?c) 1) (capacity ?c))
    :effect (increase (fuel ?c) 1))
  (:action drive
    :parameters (?c - car)
    :precondition (>= (fuel ?c) 10)
    :effect (and (there ?c) (decrease (fuel ?c) 10))))
