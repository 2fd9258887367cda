(define (problem fill) (:domain tank) (:init (= (level) 0)) (:goal (full)) (:metric maximize (level)))
