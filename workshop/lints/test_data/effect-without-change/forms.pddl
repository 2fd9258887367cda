(define (domain hall)
  (:requirements :adl :numeric-fluents)
  (:types lamp)
  (:predicates (lit ?x - lamp) (broken ?x - lamp))
  (:functions (power))
  (:action same
    :parameters (?x ?y - lamp)
    :precondition (and (lit ?x) (not (broken ?y)))
    :effect (and (lit ?x) (not (broken ?y)) (lit ?y) (increase (power) 0) (scale-up (power) 1) (increase (power) 1)))
  (:action when
    :parameters (?x - lamp)
    :effect (and (when (lit ?x) (lit ?x)) (when (lit ?x) (not (lit ?x)))
      (forall (?y - lamp) (when (and (lit ?y) (broken ?y)) (and (broken ?y) (not (lit ?y))))))))
