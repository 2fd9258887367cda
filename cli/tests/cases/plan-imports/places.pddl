(define (domain places) (:requirements :typing) (:types place) (:predicates (at ?x - place)))
