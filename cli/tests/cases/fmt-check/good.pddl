(define (domain hall)
  (:predicates (lit)))
