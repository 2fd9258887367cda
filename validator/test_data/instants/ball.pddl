(define (problem ball)
  (:domain instants)
  (:init (airborne) (= (height) 2) (= (speed) 0) (= (t) 0) (= (x) 0))
  (:goal (seen)))
