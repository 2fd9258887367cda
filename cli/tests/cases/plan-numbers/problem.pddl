(define (problem fill) (:domain tank) (:init (= (level) 0)) (:goal (full)) (:metric minimize (level)))
