; the list that was not closed swallowed the key behind it
(define (domain d)
  (:predicates (p ?x) (q ?x))
  (:action a
    :parameters (?x)
    :precondition (and (p ?x)
                       (q ?x)
    :effect (not (p ?x)))
  (:action b
    :parameters (?x
    :effect (q ?x)))
