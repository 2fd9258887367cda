(define (domain liar) (:requirements :derived-predicates :negative-preconditions)
  (:predicates (lies) (done))
  (:derived (lies) (not (lies)))
  (:action ask :parameters () :precondition (lies) :effect (done)))
