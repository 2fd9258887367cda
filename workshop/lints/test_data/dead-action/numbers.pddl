; A tank is only ever emptied: what asks for more than it starts with never applies.
(define (domain hall)
  (:requirements :numeric-fluents)
  (:predicates (moved) (flown))
  (:functions (fuel) (size))
  (:action move
    :parameters ()
    :precondition (>= (fuel) 1)
    :effect (and (moved) (decrease (fuel) 1)))
  (:action fly
    :parameters ()
    :precondition (and (moved) (> (fuel) (size)))
    :effect (flown)))

(define (problem evening)
  (:domain hall)
  (:init (= (fuel) 10) (= (size) 20))
  (:goal (moved)))
