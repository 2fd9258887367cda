; expect: cost 2
(define (problem scatter) (:domain couriers)
  (:objects v - van p q - parcel a - place)
  (:init (= (at p) a) (= (at q) a))
  (:goal (and (scattered) (torn) (= (at p) a))))
