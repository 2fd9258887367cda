(define (problem p)
  (:domain mutexes)
  (:init (a) (= (n) 2) (= (m) 0))
  (:goal ()))
