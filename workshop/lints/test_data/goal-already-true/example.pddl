(define (domain hall)
  (:requirements :typing :negative-preconditions)
  (:types lamp)
  (:predicates (lit ?x - lamp) (broken ?x - lamp))
  (:action switch
    :parameters (?x - lamp)
    :precondition (not (lit ?x))
    :effect (and (lit ?x) (broken ?x))))

(define (problem evening)
  (:domain hall)
  (:objects left - lamp)
  (:init (broken left))
  (:goal (and (lit left) (broken left))))
