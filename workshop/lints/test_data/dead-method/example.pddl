(define (domain hall)
  (:requirements :typing :hierarchy :method-preconditions)
  (:types lamp sign)
  (:predicates (lit ?x - object))
  (:task announce :parameters (?s - sign))
  (:method if-lit
    :parameters (?s - sign ?l - lamp)
    :task (announce ?s)
    :precondition (lit ?s)
    :ordered-subtasks (switch ?l))
  (:action switch
    :parameters (?l - lamp)
    :effect (lit ?l)))

(define (problem evening)
  (:domain hall)
  (:objects left - lamp exit - sign)
  (:htn
    :ordered-subtasks (switch left))
  (:init))
