(define (domain trade)
  (:requirements :typing :numeric-fluents)
  (:types market good)
  (:predicates (at ?m - market) (way ?a ?b - market))
  (:functions
    (price ?m - market ?g - good)
    (sells ?m - market ?g - good)
    (stock ?m - market ?g - good)
    (own ?g - good)
    (cash)
    (room)
    (fuel))
  (:action go
    :parameters (?a ?b - market)
    :precondition (and (at ?a) (way ?a ?b) (>= (cash) (fuel)))
    :effect (and (not (at ?a)) (at ?b) (decrease (cash) (fuel))))
  (:action buy
    :parameters (?m - market ?g - good)
    :precondition (and (at ?m) (<= (price ?m ?g) (cash)) (>= (room) 1) (>= (stock ?m ?g) 1))
    :effect (and
      (decrease (cash) (price ?m ?g))
      (increase (own ?g) 1)
      (decrease (room) 1)
      (decrease (stock ?m ?g) 1)))
  (:action sell
    :parameters (?m - market ?g - good)
    :precondition (and (at ?m) (>= (own ?g) 1))
    :effect (and
      (increase (cash) (sells ?m ?g))
      (decrease (own ?g) 1)
      (increase (room) 1)
      (increase (stock ?m ?g) 1))))
