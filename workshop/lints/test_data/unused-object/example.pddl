(define (domain hall)
  (:requirements :typing)
  (:types lamp)
  (:predicates (lit ?x - lamp) (plugged ?x - lamp))
  (:action switch
    :parameters (?x - lamp)
    :precondition (plugged ?x)
    :effect (lit ?x)))

(define (problem evening)
  (:domain hall)
  (:objects left right - lamp)
  (:init (plugged left))
  (:goal (lit left)))
