; expect: impossible Formula
(define (problem swap-with-itself) (:domain couriers)
  (:objects v - van p - parcel a b - place)
  (:init (road a b) (= (at p) a) (= (at v) b))
  (:goal (and (swapped) (= (at v) a))))
