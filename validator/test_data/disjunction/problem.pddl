(define (problem p) (:domain tea) (:objects cup) (:init) (:goal (served cup)))
