(define (domain hall)
  (:requirements :typing :conditional-effects :negative-preconditions)
  (:types lamp)
  (:predicates (lit ?l - lamp) (hot ?l - lamp) (warm ?l - lamp))
  (:action switch
    :parameters (?l - lamp)
    :effect (and (lit ?l) (when (hot ?l) (warm ?l))))
  (:action cool
    :parameters (?l - lamp)
    :precondition (warm ?l)
    :effect (and (not (lit ?l)) (not (warm ?l)) (hot ?l))))

(define (problem evening)
  (:domain hall)
  (:objects left - lamp)
  (:init)
  (:goal (lit left)))
