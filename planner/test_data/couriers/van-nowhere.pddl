; expect: cost 1
; Two fluents without a value are equal.
(define (problem van-nowhere) (:domain couriers)
  (:objects v - van p q - parcel a b - place)
  (:init (road a b) (= (at p) b))
  (:goal (= (load v) q)))
