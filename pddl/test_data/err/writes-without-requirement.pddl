(define (domain d)
  (:predicates (p ?x))
  (:writes speech p))
