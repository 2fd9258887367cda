(define (domain tally)
  (:requirements :adl :numeric-fluents :typing)
  (:types bed)
  (:predicates (taken ?b - bed) (counted))
  (:functions (count) (weight ?b - bed))
  (:action count
    :parameters ()
    :effect (and (counted) (forall (?b - bed) (when (taken ?b) (increase (count) (weight ?b)))))))
