; A parameter of a global constraint stands in the constraint's own scope.
(define (domain crane)
  (:predicates (held ?b))
  (:constraint safe :parameters (?b) :condition (not (held ?b))))
