; expect: exhausted
(define (problem two-doors) (:domain maze)
  (:objects a b c d e - cell k1 k2 - key)
  (:init (at a) (next a b) (next b a) (locked a c) (locked b d) (next d b) (next d e) (next e d) (next c a) (locked c e)
         (lies k1 a) (lies k2 d))
  (:goal (and (at c) (has k2))))
