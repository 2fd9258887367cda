(define (domain bad)
  (:predicates (p ?x - t)))
