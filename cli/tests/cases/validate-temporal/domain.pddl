(define (domain hall)
  (:predicates (lit))
  (:action light :effect (lit)))
