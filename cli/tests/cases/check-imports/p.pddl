(define (problem p) (:domain b) (:objects here - place) (:init (at here)) (:goal (near here)))
