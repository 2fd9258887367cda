; expect: cost 5
(define (problem half-litre) (:domain numbers)
  (:objects a b - jug)
  (:init (scale) (= (size a) 2) (= (size b) 3) (= (level a) 0) (= (level b) 0) (= (taken) 0) (= (steps) 0) (= (price) 8))
  (:goal (= (level a) 1.7)))
