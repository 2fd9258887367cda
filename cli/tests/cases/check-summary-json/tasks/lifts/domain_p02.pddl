(define (domain lifts)
  (:predicates (p) (q2))
  (:action a :effect (p)))
