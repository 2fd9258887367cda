(define (problem p) (:domain tank) (:init (= (level) 0) (= (limit) 0.5)) (:goal (done)) (:metric maximize (level)))
