(define (domain b) (:import a) (:predicates (near ?x - place)))
