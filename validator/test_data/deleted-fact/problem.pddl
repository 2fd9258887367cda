(define (problem p) (:domain candle) (:objects red blue) (:init (match)) (:goal (seen red)))
