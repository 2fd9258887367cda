; allow(unused-paramter)
(define (domain hall)
  (:predicates (lit ?x)) ;; allow( nothing ,unused-parameter)
  (:action switch :parameters (?x) :effect (lit ?x)))
