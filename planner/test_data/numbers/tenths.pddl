; expect: cost 2
(define (problem tenths) (:domain numbers)
  (:objects a - jug)
  (:init (scale) (= (size a) 0.3) (= (level a) 0.3) (= (taken) 0) (= (steps) 0))
  (:goal (and (weighed) (= (level a) 0))))
