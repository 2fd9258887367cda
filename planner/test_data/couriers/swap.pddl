; expect: cost 1
(define (problem swap) (:domain couriers)
  (:objects v - van p q - parcel a b - place)
  (:init (= (at v) a) (= (at p) a) (= (at q) b))
  (:goal (and (= (at p) b) (= (at q) a) (swapped))))
