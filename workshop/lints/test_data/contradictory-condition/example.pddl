(define (domain hall)
  (:requirements :typing)
  (:types cart place)
  (:predicates (at ?c - cart ?p - place) (moving ?c - cart))
  (:action start
    :parameters (?c - cart ?p - place)
    :precondition (at ?c ?p)
    :effect (and (not (at ?c ?p)) (moving ?c)))
  (:action stop
    :parameters (?c - cart ?p - place)
    :precondition (and (moving ?c) (at ?c ?p))
    :effect (and (not (moving ?c)) (at ?c ?p))))

(define (problem evening)
  (:domain hall)
  (:objects c - cart a b - place)
  (:init (at c a))
  (:goal (moving c)))
