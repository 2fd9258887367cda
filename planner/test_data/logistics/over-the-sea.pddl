; expect: cost 20.5
(define (problem over-the-sea) (:domain logistics)
  (:objects home far - place a1 a2 - airport t1 t2 - truck p - plane x y - package)
  (:init (road home a1) (road a1 home) (road a2 far) (road far a2)
         (= (length home a1) 2) (= (length a1 home) 2) (= (length a2 far) 3) (= (length far a2) 3)
         (= (total-cost) 0) (at t1 home) (at t2 far) (at p a1) (at x home) (at y a2))
  (:goal (and (at x far) (at y far)))
  (:metric minimize (total-cost)))
