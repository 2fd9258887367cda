(define (domain hall)
  (:requirements :adl)
  (:types lamp)
  (:predicates (lit ?x - lamp))
  (:action switch
    :parameters (?x - lamp)
    :precondition (or (exists (?y - lamp) (lit ?x)) (forall (?y ?z - lamp) (lit ?z)))
    :effect (and (lit ?x) (forall (?w - lamp) (when (lit ?x) (not (lit ?x)))))))

(define (problem evening)
  (:domain hall)
  (:objects left - lamp)
  (:init)
  (:goal (and (lit left) (exists (?x ?y - lamp) (not (lit ?x))))))
