(define (domain tea)
  (:requirements :strips :typing)
  (:types person item)
  (:predicates (greeted ?p - person) (ordered ?i - item))
  (:action greet
    :parameters (?p - person)
    :effect (greeted ?p))
  (:action ask
    :parameters (?p - person ?i - item)
    :precondition (greeted ?p)
    :effect (ordered ?i)))
