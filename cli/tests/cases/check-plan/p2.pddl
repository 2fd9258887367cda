(define (problem p2) (:domain hall) (:objects torch) (:init (unknown)) (:goal (lit torch)))
