; expect: cost 4
(define (problem both)
  (:domain post)
  (:objects l - letter b - parcel v - van p q - place)
  (:init (at l p) (at b p) (at v q))
  (:goal (forall (?x - thing) (or (van ?x) (in ?x)))))
