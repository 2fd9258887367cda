; Others import it.
(define (domain dictionary)
  (:requirements :typing)
  (:types lamp)
  (:predicates (lit ?x - lamp) (broken ?x - lamp)))
