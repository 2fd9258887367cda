(define (domain hall)
  (:requirements :adl :derived-predicates)
  (:types lamp)
  (:predicates (lit ?x - lamp) (dark ?y - lamp))
  (:derived (dark ?y - lamp) (not (exists (?y - lamp) (lit ?y))))
  (:action switch
    :parameters (?x - lamp)
    :precondition (forall (?y - lamp) (exists (?Y - lamp) (lit ?y)))
    ; Not inside of the first one: nothing is hidden.
    :effect (and (forall (?z - lamp) (lit ?z)) (forall (?z - lamp) (when (dark ?x) (lit ?z))))))

(define (problem evening)
  (:domain hall)
  (:objects left - lamp)
  (:init)
  (:goal (exists (?a - lamp) (and (lit ?a) (forall (?a - lamp) (dark ?a))))))
