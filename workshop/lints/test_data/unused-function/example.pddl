(define (domain hall)
  (:requirements :typing :numeric-fluents)
  (:types lamp)
  (:predicates (lit ?x - lamp))
  (:functions (power ?x - lamp))
  (:action switch
    :parameters (?x - lamp)
    :effect (lit ?x)))

(define (problem evening)
  (:domain hall)
  (:objects left - lamp)
  (:init (= (power left) 5))
  (:goal (lit left)))
