(define (domain hall)
  (:requirements :numeric-fluents)
  (:predicates (lit))
  (:functions (power) (price))
  (:action switch
    :precondition (> (power) 3)
    :effect (and (lit) (decrease (power) 1))))

(define (problem evening)
  (:domain hall)
  (:init (= (power) 5) (= (price) 2))
  (:goal (lit))
  (:metric minimize (price)))
