(define (domain host)
  (:requirements :strips :typing)
  (:types person item)
  (:predicates (greeted ?p - person) (ordered ?i - item) (parted))
  (:action greet
    :parameters (?p - person)
    :effect (greeted ?p))
  (:action ask
    :parameters (?p - person ?i - item)
    :precondition (greeted ?p)
    :effect (ordered ?i))
  (:action part
    :parameters (?p - person)
    :precondition (greeted ?p)
    :effect (parted)))
