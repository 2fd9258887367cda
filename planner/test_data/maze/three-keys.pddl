; expect: cost 3
(define (problem three-keys) (:domain maze)
  (:objects a b c d - cell k1 k2 - key)
  (:init (at a) (next a b) (next b a) (locked a c) (locked b d) (next d b) (lies k1 a) (lies k2 d))
  (:goal (at c)))
