(define (problem batter)
  (:domain durations)
  (:init (= (heat) 3) (= (thickness) 1))
  (:goal (stirred)))
