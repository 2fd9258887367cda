; expect: impossible Formula
(define (problem not-lent) (:domain numbers)
  (:objects a - jug)
  (:init (= (level a) 1))
  (:goal (> (spare) 0)))
