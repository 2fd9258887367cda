; five independent mistakes, two of them in parentheses
(define (domain d)
  (:requirements :strips :typing)
  (:types t)
  (:predicates (p ?x - t) (q ?x - u))
  (:action a
    :parameters (?x - t)
    :precondition (and (p ?x)
    :effect (not (p ?x)))
  (:action b
    :parameters (?x - t)
    :effect (p ?y))
  (:action c
    :parameters (?x - t))
    :effect (and (p ?x) (r ?x)))
  (:akshun d))
