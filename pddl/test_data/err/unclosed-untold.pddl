; nothing tells which
(define (domain d)
  (:predicates (p ?x))
  (:action a :parameters (?x) :effect (and (p ?x) (not (p ?x))))
