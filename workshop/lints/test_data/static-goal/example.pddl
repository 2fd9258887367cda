(define (domain hall)
  (:requirements :typing)
  (:types lamp)
  (:predicates (lit ?x - lamp) (broken ?x - lamp))
  (:action switch
    :parameters (?x - lamp)
    :precondition (broken ?x)
    :effect (lit ?x)))

(define (problem evening)
  (:domain hall)
  (:objects left - lamp)
  (:init (broken left))
  (:goal (and (lit left) (broken left))))
