(define (problem tank)
  (:domain tanks)
  (:init (= (level) 0) (= (speed) 0) (= (height) 0) (= (energy) 0))
  (:goal (full)))
