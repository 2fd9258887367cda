(define (problem x)
  (:domain none)
  (:init)
  (:goal (p)))
