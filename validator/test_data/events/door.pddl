(define (problem door)
  (:domain events)
  (:init (open) (at 5 (not (open))) (= (clock) 0) (= (count) 0))
  (:goal (shut-out)))
