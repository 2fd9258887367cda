(define (domain host)
  (:requirements :strips :typing)
  (:types person item)
  (:predicates
    (greeted ?p - person)
    (ordered ?i - item)
    (parted)
    (toasted ?p - person)
    (has_glass ?p - person))
  (:action greet
    :parameters (?p - person)
    :effect (greeted ?p))
  (:action ask
    :parameters (?p - person ?i - item)
    :precondition (greeted ?p)
    :effect (ordered ?i))
  (:action toast
    :parameters (?p - person)
    :precondition (and (greeted ?p) (has_glass ?p))
    :effect (toasted ?p))
  (:action part
    :parameters (?p - person)
    :precondition (greeted ?p)
    :effect (parted)))
