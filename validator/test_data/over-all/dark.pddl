(define (problem dark)
  (:domain lamps)
  (:init (powered))
  (:goal (read)))
