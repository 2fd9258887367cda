(define (domain lines)
  (:requirements :typing)
  ; café
  (:types a b - object)
  (:predicates (p ?x - a)	(größer ?y))
  (:action go	:parameters (?x - a)
    :effect (p ?x)))
(define (problem p) (:domain lines) (:objects o - a) (:init (größer o)) (:goal (p o)))
