(define (domain hall)
  (:requirements :typing)
  (:types lamp)
  (:predicates (lit ?x - lamp) (warm ?x - lamp))
  (:action switch
    :parameters (?x - lamp)
    :effect (and (lit ?x) (warm ?x))))

(define (problem evening)
  (:domain hall)
  (:objects left - lamp)
  (:init)
  (:goal (lit left)))
