; expect: impossible Formula
(define (problem no-twins) (:domain couriers)
  (:objects v - van p q - parcel a b - place)
  (:init (road a b) (= (at v) a) (= (at p) b))
  (:goal (= (twin q) p)))
