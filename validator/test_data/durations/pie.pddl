(define (problem pie)
  (:domain durations)
  (:init (= (heat) 3) (= (thickness) 1))
  (:goal (and (cooled) (= (heat) 0.5))))
