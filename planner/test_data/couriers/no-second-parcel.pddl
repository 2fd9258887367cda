; expect: exhausted
; With one parcel, `scatter` would give it two values.
(define (problem no-second-parcel) (:domain couriers)
  (:objects v - van p - parcel a - place)
  (:init (= (at p) a))
  (:goal (or (scattered) (and (torn) (= (at p) a)))))
