(define (domain hall)
  (:requirements :typing :equality)
  (:types lamp room)
  (:predicates (lit ?x - lamp) (warm ?x - lamp))
  ; It is dark there.
  ; allow(unused-parameter)
  (:action switch :parameters (?x - lamp ?r - room) :effect (and (lit ?x) (warm ?x))))
