(define (problem p) (:domain swap) (:objects l r ball cube) (:init (in ball l) (in cube r))
  (:goal (and (in ball r) (in cube l) (not (in ball l)) (not (in cube r)))))
