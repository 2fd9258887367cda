(define (domain n) (:requirements :fluents) (:functions (f ?x) - number (g)) (:predicates (p))
(:action a :parameters (?x) :precondition (>= (* 2 (f ?x)) (- (+ (g) 1 2)))
:effect (and (increase (f ?x) (/ (g) 3)) (when (p) (assign (g) 1e-3)) (scale-up (g) .5))))
