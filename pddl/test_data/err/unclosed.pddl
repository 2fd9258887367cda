(define (domain d)
  (:predicates (p) (q)
  (:action a :parameters () :precondition (and (p) (q) :effect (r))
  (:action b :parameters () :effect (p)))
