(define (problem p) (:domain lamp) (:init)
  (:goal (and (lit) (preference w (warm)))))
