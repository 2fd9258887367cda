(define (problem x)
  (:domain lifts)
  (:init)
  (:goal (q1)))
