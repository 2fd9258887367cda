(define (problem bench) (:domain lab) (:objects a b - lamp) (:init) (:goal (and)))
