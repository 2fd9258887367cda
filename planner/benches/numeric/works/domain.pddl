(define (domain works)
  (:requirements :typing :numeric-fluents)
  (:types place cart)
  (:predicates
    (at ?c - cart ?p - place)
    (road ?a ?b - place)
    (mill ?p - place)
    (forge ?p - place)
    (wood ?p - place)
    (ore ?p - place))
  (:functions
    (timber ?p - place)
    (iron ?p - place)
    (room ?c - cart)
    (ctimber ?c - cart)
    (ciron ?c - cart)
    (houses ?p - place)
    (labour))
  (:action fell
    :parameters (?p - place)
    :precondition (wood ?p)
    :effect (and (increase (timber ?p) 1) (increase (labour) 1)))
  (:action dig
    :parameters (?p - place)
    :precondition (and (ore ?p) (mill ?p))
    :effect (and (increase (iron ?p) 1) (increase (labour) 2)))
  (:action build-mill
    :parameters (?p - place)
    :precondition (>= (timber ?p) 3)
    :effect (and (mill ?p) (decrease (timber ?p) 3)))
  (:action build-forge
    :parameters (?p - place)
    :precondition (and (>= (timber ?p) 2) (>= (iron ?p) 2))
    :effect (and (forge ?p) (decrease (timber ?p) 2) (decrease (iron ?p) 2)))
  (:action build-house
    :parameters (?p - place)
    :precondition (and (forge ?p) (>= (timber ?p) 4) (>= (iron ?p) 2))
    :effect (and (increase (houses ?p) 1) (decrease (timber ?p) 4) (decrease (iron ?p) 2)))
  (:action load-timber
    :parameters (?c - cart ?p - place)
    :precondition (and (at ?c ?p) (>= (room ?c) 1) (>= (timber ?p) 1))
    :effect (and (decrease (timber ?p) 1) (increase (ctimber ?c) 1) (decrease (room ?c) 1)))
  (:action unload-timber
    :parameters (?c - cart ?p - place)
    :precondition (and (at ?c ?p) (>= (ctimber ?c) 1))
    :effect (and (increase (timber ?p) 1) (decrease (ctimber ?c) 1) (increase (room ?c) 1)))
  (:action load-iron
    :parameters (?c - cart ?p - place)
    :precondition (and (at ?c ?p) (>= (room ?c) 1) (>= (iron ?p) 1))
    :effect (and (decrease (iron ?p) 1) (increase (ciron ?c) 1) (decrease (room ?c) 1)))
  (:action unload-iron
    :parameters (?c - cart ?p - place)
    :precondition (and (at ?c ?p) (>= (ciron ?c) 1))
    :effect (and (increase (iron ?p) 1) (decrease (ciron ?c) 1) (increase (room ?c) 1)))
  (:action drive
    :parameters (?c - cart ?a ?b - place)
    :precondition (and (at ?c ?a) (road ?a ?b))
    :effect (and (not (at ?c ?a)) (at ?c ?b))))
