; read, named as unsupported, and the rest is still a model
(define (domain later)
  (:predicates (p ?x))
  (:safety (forall (?x) (not (p ?x))))
  (:action a :parameters (?x) :precondition (p ?x) :effect (p ?x) :expansion :methods))
(define (problem later-1) (:domain later) (:situation start) (:objects b) (:init) (:goal (p b)))
