; Events make true, a trajectory may do without, a preference and a process need what nothing gives.
(define (domain hall)
  (:requirements :typing :preferences :constraints :time :continuous-effects :numeric-fluents)
  (:types lamp)
  (:predicates (lit ?x - lamp) (hot) (never) (dry) (wished ?x - lamp))
  (:functions (heat))
  (:constraints (at-most-once (never)))
  (:process warm
    :parameters ()
    :precondition (dry)
    :effect (increase (heat) (* #t 2)))
  (:event boil
    :parameters ()
    :precondition (>= (heat) 100)
    :effect (hot))
  (:action light
    :parameters (?x - lamp)
    :precondition (and (hot) (preference asked (wished ?x)))
    :effect (lit ?x)))

(define (problem evening)
  (:domain hall)
  (:objects left - lamp)
  (:init (= (heat) 0))
  (:goal (lit left)))
