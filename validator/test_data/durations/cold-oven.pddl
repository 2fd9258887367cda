(define (problem cold-oven)
  (:domain durations)
  (:init (= (heat) 0) (= (thickness) 1))
  (:goal (warm)))
