(define (problem dough)
  (:domain durations)
  (:init (= (heat) 3) (= (thickness) 1))
  (:goal (rested)))
