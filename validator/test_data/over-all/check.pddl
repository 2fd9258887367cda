(define (problem check)
  (:domain lamps)
  (:init (powered) (lit))
  (:goal (spare)))
