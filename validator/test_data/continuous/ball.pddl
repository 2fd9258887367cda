(define (problem ball)
  (:domain tanks)
  (:init (= (level) 1) (= (speed) 0) (= (height) 0) (= (energy) 0))
  (:goal (ready)))
