(define (domain rounds)
  (:requirements :strips :typing)
  (:types room item)
  (:predicates (at ?r - room) (in ?i - item ?r - room) (has ?i - item) (free) (door ?a ?b - room))
  (:action go
    :parameters (?from ?to - room)
    :precondition (and (at ?from) (door ?from ?to))
    :effect (and (at ?to) (not (at ?from))))
  (:action take
    :parameters (?i - item ?r - room)
    :precondition (and (at ?r) (in ?i ?r) (free))
    :effect (and (has ?i) (not (in ?i ?r)) (not (free))))
  (:action put
    :parameters (?i - item ?r - room)
    :precondition (and (at ?r) (has ?i))
    :effect (and (in ?i ?r) (free) (not (has ?i)))))
