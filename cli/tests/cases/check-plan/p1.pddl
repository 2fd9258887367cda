(define (problem p1) (:domain hall) (:objects lamp) (:init) (:goal (lit lamp)))
