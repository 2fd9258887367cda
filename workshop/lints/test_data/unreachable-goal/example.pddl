(define (domain hall)
  (:requirements :typing)
  (:types lamp)
  (:predicates (lit ?l - lamp) (plugged ?l - lamp))
  (:action switch
    :parameters (?l - lamp)
    :precondition (plugged ?l)
    :effect (lit ?l)))

(define (problem evening)
  (:domain hall)
  (:objects left right - lamp)
  (:init (plugged left))
  (:goal (and (lit left) (lit right))))
