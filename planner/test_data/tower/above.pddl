; expect: cost 8
(define (problem above) (:domain tower)
  (:objects a b c d - block)
  (:init (on-table d) (on c d) (on b c) (on-table a))
  (:goal (and (above d a) (above a b) (not (above c b)))))
