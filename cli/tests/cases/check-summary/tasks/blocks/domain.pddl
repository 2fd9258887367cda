(define (domain blocks)
  (:predicates (p) (q))
  (:action a :effect (p)))
