(define (problem p) (:domain tolls) (:objects a b c)
  (:init (at a) (road a b) (road b c) (road a c) (= (total-cost) 0)
         (= (toll a b) 2) (= (toll b c) 3) (= (toll a c) 9))
  (:goal (at c)) (:metric minimize (total-cost)))
