; expect: unsupported numeric fluents
(define (problem tank) (:domain numbers) (:init (= (fuel) 1)) (:goal (done)))
