(define (domain hall)
  (:requirements :adl)
  (:types lamp)
  (:predicates (lit ?x - lamp) (broken ?x - lamp))
  (:action forms
    :parameters (?x ?y - lamp)
    :precondition (and (lit ?x) (not (broken ?y)))
    :effect (and (when (and) (broken ?x)) (when (and (lit ?x) (not (broken ?y))) (lit ?y))
      (when (and (lit ?x) (broken ?x)) (lit ?y)) (forall (?z - lamp) (when (lit ?z) (broken ?z))))))
