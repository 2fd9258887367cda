(define (problem both) (:domain lamps) (:objects a b - lamp)
  (:init (first a) (next a b)) (:goal (and (bright a) (bright b))))
