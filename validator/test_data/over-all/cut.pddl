(define (problem cut)
  (:domain lamps)
  (:init (lit))
  (:goal (read)))
