; Latin-1: été
(define (domain latin) (:predicates (p)))
