(define (problem first) (:domain second) (:objects a) (:init (not (p a)) ) (:goal (not (p a))))
(define (domain second) (:predicates (p ?x)) (:action x :parameters (?a) :precondition (p ?a) :effect (not (p ?a))))
