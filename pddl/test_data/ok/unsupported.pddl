; read, named as unsupported, and the rest is still a model
(define (domain later)
  (:predicates (p ?x))
  (:action a :parameters (?x) :vars (?y) :precondition (p ?x) :effect (p ?y)))
