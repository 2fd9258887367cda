(define (problem oven)
  (:domain durations)
  (:init (= (heat) 3) (= (thickness) 1))
  (:goal (warm)))
