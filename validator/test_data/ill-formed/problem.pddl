(define (problem p)
  (:domain liar)
  (:init)
  (:goal (done)))
