(define (domain hall)
  (:requirements :typing :numeric-fluents)
  (:types lamp)
  (:predicates (lit ?x - lamp))
  (:functions (used))
  (:action switch
    :parameters (?x - lamp)
    :effect (and (lit ?x) (increase (used) 1))))

(define (problem evening)
  (:domain hall)
  (:objects left - lamp)
  (:init (= (used) 0))
  (:goal (lit left)))
