(define (problem evening)
  (:domain hall)
  (:init)
  (:goal (lit)))
