(define (domain old)
  (:predicates (p ?x))
  (:action a :parameters (?x) :observe (p ?x) :effect (p ?x)))
