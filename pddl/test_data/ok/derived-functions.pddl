; numbers that are computed: an attribute, and a count; a function may be called `count`
(define (domain counters)
  (:requirements :adl :fluents :derived-predicates)
  (:types item question)
  (:predicates (asked-in ?q - question ?i - item))
  (:functions (asked ?i - item) (score ?i - item) (points ?i - item) (count ?i - item) (again ?i) (all))
  (:derived (asked ?i) (count (?q - question) (asked-in ?q ?i)))
  (:derived (points ?i - item) (+ (score ?i) 1))
  (:derived (again ?i - item) (count ?i))
  (:derived (all) (count (?q - question ?i - item) (and (asked-in ?q ?i) (not (= (score ?i) 0)))))
  (:action ask :parameters (?i - item) :precondition (< (asked ?i) 2) :effect (increase (score ?i) 1)))

(define (problem p) (:domain counters) (:objects i - item q - question) (:init) (:goal (asked-in q i)))
