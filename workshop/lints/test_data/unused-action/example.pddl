(define (domain hall)
  (:requirements :typing :hierarchy)
  (:types lamp)
  (:predicates (lit ?x - lamp))
  (:task brighten
    :parameters (?x - lamp))
  (:method by-hand
    :parameters (?x - lamp)
    :task (brighten ?x)
    :ordered-subtasks (switch ?x))
  (:action shout
    :parameters ()
    :effect ())
  (:action switch
    :parameters (?x - lamp)
    :effect (lit ?x)))

(define (problem evening)
  (:domain hall)
  (:objects left - lamp)
  (:htn
    :ordered-subtasks (brighten left))
  (:init))
