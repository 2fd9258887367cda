(define (problem p) (:domain nobody) (:objects ana - nurse) (:init) (:goal (done)))
