; no types, no requirements, sections out of order, both definitions in one file
(define (domain hall)
  (:action switch
    :parameters (?x ?y)
    :precondition (and (lit ?x) (not (lit ?y)) (not (= ?x ?y)))
    :effect (and (lit ?y) (not (lit ?x))))
  (:action nothing)
  (:action bare :precondition () :effect ())
  (:action REST :effect (rested))
  (:predicates (lit ?x) (rested)))

(define (problem two-lamps)
  (:domain HALL)
  (:objects a B)
  (:goal (and (LIT b) (rested)))
  (:init (lit a) (not (lit b))))
