(define (domain old)
  (:predicates (p ?x))
  (:action a :parameters (?x) :vars (?y) :effect (p ?y)))
