; expect: cost 2
(define (problem both-in-one) (:domain couriers)
  (:objects v - van p q - parcel a - place)
  (:init (= (at v) a) (= (at p) a) (= (at q) a))
  (:goal (and (= (load v) p) (= (at p) a))))
