(define (domain d) (:requirements :time) (:predicates (on)) (:functions (level))
(:process fill :parameters () :precondition (on) :effect (increase (level) (* #t 2)))
(:event full :parameters () :precondition (>= (level) 5) :effect (not (on))))
(define (problem e) (:domain d) (:init (on) (= (level) 0)) (:goal (not (on))))
