(define (domain a) (:requirements :typing) (:types place) (:predicates (at ?x - place)))
