; closing parentheses on their own lines
(define (domain d)
  (:predicates
    (p ?x)
    (q ?x)
  )
  (:action a
    :parameters (?x)
    :effect (and
      (p ?x)
      (not (q ?x)
    )
  )
)
