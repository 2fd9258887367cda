(define (domain hall)
  (:predicates (lit ?x))
  (:action switch :parameters (?x) :effect (lit ?x)))
