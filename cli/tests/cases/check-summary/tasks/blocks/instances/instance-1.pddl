(define (problem x)
  (:domain blocks)
  (:init)
  (:goal (p)))
