(define (domain hall)
  (:requirements :typing)
  (:types cart place)
  (:predicates (at ?c - cart ?p - place))
  (:action move
    :parameters (?c - cart ?p ?q - place)
    :precondition (at ?c ?p)
    :effect (and (not (at ?c ?p)) (at ?c ?q))))

(define (problem evening)
  (:domain hall)
  (:objects c d - cart a b - place)
  (:init (at c a) (at d a))
  (:goal (and (at c b) (at c a))))
