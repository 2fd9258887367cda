(define (problem evening)
  (:domain bath)
  (:init (dirty) (= (level) 0))
  (:goal (and (usable) (>= (level) 20))))
