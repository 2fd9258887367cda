(define (problem p) (:domain network) (:objects plant a b c)
  (:init (source plant) (wire plant a) (wire a b))
  (:goal (and (not (alarm)) (repaired c))))
