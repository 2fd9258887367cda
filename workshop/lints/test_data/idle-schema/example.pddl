(define (domain hall)
  (:requirements :typing)
  (:types lamp)
  (:predicates (lit ?l - lamp) (left-of ?a ?b - lamp))
  (:action switch
    :parameters (?l - lamp)
    :effect (lit ?l))
  (:action switch-between
    :parameters (?l ?a ?b - lamp)
    :precondition (and (left-of ?a ?l) (left-of ?l ?b))
    :effect (lit ?l)))

(define (problem evening)
  (:domain hall)
  (:objects a b - lamp)
  (:init (left-of a b))
  (:goal (and (lit a) (lit b))))
