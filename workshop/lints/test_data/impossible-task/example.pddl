(define (domain hall)
  (:requirements :typing :hierarchy :method-preconditions)
  (:types lamp)
  (:predicates (lit ?l - lamp) (plugged ?l - lamp))
  (:task brighten :parameters (?l - lamp))
  (:method by-hand
    :parameters (?l - lamp)
    :task (brighten ?l)
    :precondition (plugged ?l)
    :ordered-subtasks (switch ?l))
  (:action switch
    :parameters (?l - lamp)
    :effect (lit ?l)))

(define (problem evening)
  (:domain hall)
  (:objects left right - lamp)
  (:htn
    :ordered-subtasks (and (brighten left) (brighten right)))
  (:init (plugged left)))
