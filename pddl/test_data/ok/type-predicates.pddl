; types as predicates, and sorts where a predicate has the type's name
(define (domain zoo)
  (:requirements :adl)
  (:types bird fish - animal and cage)
  (:predicates (cage ?x) (in ?x ?y) (tame ?x))
  (:derived (tame ?x) (or (bird ?x) (sortof ?x - (either fish bird))))
  (:action move
    :parameters (?x ?y)
    :precondition (and (animal ?x) (not (fish ?x)) (sort ?y - cage) (cage ?y) (sortof ?x - and) (object ?y)
                       (forall (?z) (imply (and (bird ?z)) (not (in ?z ?y)))))
    :effect (when (bird ?x) (in ?x ?y))))

(define (problem p) (:domain zoo) (:objects a - bird c - cage) (:init) (:goal (exists (?x) (and (bird ?x) (tame ?x)))))
