; five mistakes that have nothing to do with each other, five diagnostics
(define (domain five)
  (:requirements :typing)
  (:types car place)
  (:predicates (at ?c - car ?p - plaec) (free ?p - place)
  (:action go :parameters (?c - car ?p - place)
    :precondition (and (free ?q) (not (at ?c ?p)))
    :effect (and (at ?c ?p) (fre ?p)))
  (:action stop :paramters (?c - car) :effect ()))
