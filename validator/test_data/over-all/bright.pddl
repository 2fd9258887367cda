(define (problem bright)
  (:domain lamps)
  (:init (powered) (lit))
  (:goal (read)))
