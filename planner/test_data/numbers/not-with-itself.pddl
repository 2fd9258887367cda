; expect: cost 1
(define (problem not-with-itself) (:domain numbers)
  (:objects a b - jug)
  (:init (= (price) -1) (= (level a) 1) (= (level b) 1) (= (size a) 1))
  (:goal (and (sealed) (= (level a) 0) (= (level b) 2))))
