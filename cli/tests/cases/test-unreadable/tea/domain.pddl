(define (domain tea)
  (:requirements :strips :typing :negative-preconditions)
  (:types cup)
  (:predicates (clean ?c - cup) (full ?c - cup) (hot))
  (:action boil
    :precondition (not (hot))
    :effect (hot))
  (:action pour
    :parameters (?c - cup)
    :precondition (and (hot) (clean ?c))
    :effect (and (full ?c) (not (clean ?c)))))
