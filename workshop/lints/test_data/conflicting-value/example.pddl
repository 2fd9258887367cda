(define (domain hall)
  (:requirements :numeric-fluents)
  (:predicates (lit))
  (:functions (power))
  (:action switch
    :precondition (> (power) 3)
    :effect (and (lit) (decrease (power) 1))))

(define (problem evening)
  (:domain hall)
  (:init (= (power) 5) (= (power) 7))
  (:goal (lit)))
