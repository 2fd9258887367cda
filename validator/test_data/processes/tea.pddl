(define (problem tea)
  (:domain kettles)
  (:init (= (heat) 20) (= (high) 5) (= (speed) 0) (= (count) 0))
  (:goal (heard)))
