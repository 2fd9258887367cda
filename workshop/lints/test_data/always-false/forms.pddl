(define (domain hall)
  (:requirements :adl :numeric-fluents :durative-actions)
  (:types lamp)
  (:constants left right - lamp)
  (:predicates (lit ?x - lamp) (broken ?x - lamp))
  (:functions (power))
  (:action contradiction
    :parameters (?x ?y - lamp)
    :precondition (and (lit ?x) (and (broken ?x) (not (lit ?y))) (not (lit ?x)))
    :effect (lit ?y))
  (:action inside
    :parameters (?x - lamp)
    :precondition (or (lit ?x) (exists (?z - lamp) (and (lit ?z) (not (lit ?z)))))
    :effect (when (and (broken ?x) (not (broken ?x))) (lit ?x)))
  (:action equality
    :parameters (?x - lamp)
    :precondition (or (not (= ?x ?x)) (= left right) (> 2 (power)) (> 2 3) (< (power) (power)))
    :effect (lit ?x))
  (:durative-action times
    :parameters (?x - lamp)
    :duration (= ?duration 1)
    ; At different times both may hold.
    :condition (and (at start (lit ?x)) (at end (not (lit ?x))) (at end (broken ?x)) (at end (not (broken ?x))))
    :effect (at end (lit ?x))))

(define (problem evening)
  (:domain hall)
  (:init)
  (:goal (and (lit left) (not (lit left)))))
