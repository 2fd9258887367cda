(define (problem wave)
  (:domain instants)
  (:init (waving) (steady) (= (height) 0) (= (speed) 0) (= (t) 0) (= (x) -2))
  (:goal (seen)))
