(define (problem later-door)
  (:domain events)
  (:init (open) (at 6 (not (open))) (= (clock) 0) (= (count) 0))
  (:goal (shut-out)))
