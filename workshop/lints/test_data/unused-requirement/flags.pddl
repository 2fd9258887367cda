(define (domain hall)
  (:requirements :strips :typing :equality :disjunctive-preconditions :fluents
    :derived-predicates :durative-actions)
  (:types lamp)
  (:predicates (lit ?x - lamp))
  (:action switch :parameters (?x - lamp) :effect (lit ?x)))

; The goal needs one of them.
(define (problem evening)
  (:domain hall)
  (:objects left right - lamp)
  (:init)
  (:goal (or (lit left) (lit right))))
