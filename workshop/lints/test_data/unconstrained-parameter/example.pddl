(define (domain hall)
  (:predicates (lamp ?x) (room ?x) (lit ?x) (in ?x ?r))
  (:action switch
    :parameters (?x ?r)
    :precondition (and (room ?r) (in ?x ?r))
    :effect (lit ?x))
  (:action carry
    :parameters (?x ?from ?to)
    :precondition (and (lamp ?x) (room ?from) (in ?x ?from))
    :effect (and (in ?x ?to) (not (in ?x ?from)))))
