(define (problem bread)
  (:domain durations)
  (:init (= (heat) 3) (= (thickness) 1))
  (:goal (baked)))
