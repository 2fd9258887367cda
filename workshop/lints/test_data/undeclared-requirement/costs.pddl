; More than costs.
(define (domain hall)
  (:requirements :action-costs)
  (:predicates (lit))
  (:functions (power) (total-cost))
  (:action switch :parameters () :effect (and (lit) (increase (power) 1) (increase (total-cost) 1))))
