(define (problem evening) (:domain hall) (:objects left - lamp here - room) (:init) (:goal (lit left)))
