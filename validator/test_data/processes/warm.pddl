(define (problem warm)
  (:domain kettles)
  (:init (= (heat) 99) (= (high) 5) (= (speed) 0) (= (count) 0))
  (:goal (whistles)))
