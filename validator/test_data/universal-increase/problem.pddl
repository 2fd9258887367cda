(define (problem p) (:domain tally) (:objects x y z - bed)
  (:init (= (count) 0) (taken x) (taken z) (= (weight x) 2) (= (weight y) 10) (= (weight z) 5))
  (:goal (and (counted) (= (count) 7))))
