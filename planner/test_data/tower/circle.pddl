; expect: exhausted
(define (problem circle) (:domain tower)
  (:objects a b c - block)
  (:init (on-table a) (on-table b) (on-table c))
  (:goal (and (above a b) (above b a))))
