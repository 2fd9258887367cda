(define (problem battery)
  (:domain tanks)
  (:init (= (level) 0) (= (speed) 3) (= (height) 0) (= (energy) 0))
  (:goal (= (energy) 27)))
