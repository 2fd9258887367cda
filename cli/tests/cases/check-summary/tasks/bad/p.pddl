(define (problem x)
  (:domain bad)
  (:init)
  (:goal (p)))
