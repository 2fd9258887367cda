(define (domain ship) (:requirements :preferences) (:predicates (done)))

(define (problem p)
  (:domain ship)
  (:init)
  (:goal (preference first (done)))
  (:metric minimize (+ (is-violated frist) (is-violated other) (is-violated first))))
