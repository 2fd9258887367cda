; expect: solvable
(define (problem thrifty) (:domain numbers)
  (:objects a b - jug)
  (:init (= (size a) 5) (= (size b) 3) (= (level a) 0) (= (level b) 0) (= (taken) 0) (= (steps) 0) (= (price) 8))
  ; Six steps take ten litres, eight take nine.
  (:goal (= (level a) 4))
  (:metric minimize (taken)))
