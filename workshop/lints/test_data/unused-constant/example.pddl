(define (domain hall)
  (:requirements :typing)
  (:types lamp)
  (:constants main spare - lamp)
  (:predicates (lit ?x - lamp))
  (:action switch
    :effect (lit main)))

(define (problem evening)
  (:domain hall)
  (:init)
  (:goal (lit main)))
