; in the last section, which took the closing parenthesis of the definition
(define (domain d)
  (:predicates (p ?x) (q ?x))
  (:action a
    :parameters (?x)
    :precondition (p ?x)
    :effect (and (not (p ?x)
                 (q ?x))))
