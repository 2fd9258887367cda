(define (domain hall) (:predicates (lit ?x)) (:action light :parameters (?x) :effect (lit ?x)))
