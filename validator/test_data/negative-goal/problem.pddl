(define (problem p) (:domain sterile)
  (:objects a b c - room)
  (:init (at a) (dirty b))
  (:goal (and (at b) (not (dirty b)))))
