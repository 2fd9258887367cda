(define (problem swell)
  (:domain instants)
  (:init (waving) (= (height) 0) (= (speed) 0) (= (t) 0) (= (x) -2))
  (:goal (seen)))
