(define (problem new-oven)
  (:domain durations)
  (:init (= (thickness) 1))
  (:goal (warm)))
