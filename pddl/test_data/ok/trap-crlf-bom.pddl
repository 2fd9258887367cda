(define (domain lines)
  (:requirements :typing)
  ; café
  (:types a b - object)
  (:predicates (p ?x - a)	(q ?y))
  (:action go	:parameters (?x - a)
    :effect (p ?x)))
(define (problem p) (:domain lines) (:objects o - a) (:init (q o)) (:goal (p o)))
