; expect: solvable
(define (problem least-water) (:domain numbers)
  (:objects a b - jug)
  (:init (= (size a) 5) (= (size b) 3) (= (level a) 0) (= (level b) 0) (= (taken) 0) (= (steps) 0) (= (price) 8))
  (:goal (= (level a) 1))
  (:metric minimize (taken)))
