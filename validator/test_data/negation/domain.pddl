(define (domain sterile)
  (:requirements :strips :typing :negative-preconditions :equality)
  (:types room)
  (:predicates (at ?r - room) (dirty ?r - room) (clean ?r - room))
  (:action go
    :parameters (?from ?to - room)
    :precondition (and (at ?from) (not (= ?from ?to)) (not (dirty ?to)))
    :effect (and (at ?to) (not (at ?from))))
  (:action wash
    :parameters (?r ?next - room)
    :precondition (and (dirty ?next) (at ?r))
    :effect (and (not (dirty ?next)) (clean ?next)))
  (:action soil
    :parameters (?r - room)
    :precondition (at ?r)
    :effect (dirty ?r))
  (:action rest
    :parameters (?r ?same - room)
    :precondition (and (at ?r) (= ?r ?same))
    :effect (clean ?r)))
