(define (domain lifts)
  (:predicates (p) (q1))
  (:action a :effect (p)))
