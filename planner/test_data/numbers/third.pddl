; expect: cost 4
(define (problem third) (:domain numbers)
  (:objects a - jug)
  (:init (= (size a) 3) (= (level a) 0) (= (taken) 0) (= (spare) 0) (= (steps) 0) (= (price) 8))
  (:goal (and (split) (= (* 3 (share)) (price)))))
