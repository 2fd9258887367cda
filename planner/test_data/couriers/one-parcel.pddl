; expect: cost 5
(define (problem one-parcel) (:domain couriers)
  (:objects v - van p - parcel a b c - place)
  (:init (road a b) (road b c) (road b a) (road c b) (= (at v) a) (= (at p) c))
  (:goal (= (at p) b)))
