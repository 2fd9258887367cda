(define (problem hot)
  (:domain kettles)
  (:init (= (heat) 100) (= (high) 5) (= (speed) 0) (= (count) 0))
  (:goal (whistles)))
