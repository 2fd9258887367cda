(define (domain hall)
  (:requirements :domain-axioms :existential-preconditions)
  (:predicates (lit) (dark) (broken ?x))
  (:derived (dark) (exists (?x) (broken ?x)))
  (:action switch
    :precondition (dark)
    :effect (lit)))
