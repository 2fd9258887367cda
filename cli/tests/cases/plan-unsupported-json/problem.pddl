(define (problem fill) (:domain tank) (:init) (:goal (full)))
