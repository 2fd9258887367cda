(define (problem p)
  (:domain wins)
  (:init (p))
  (:goal (p)))
