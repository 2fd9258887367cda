(define (domain hall)
  (:requirements :typing :derived-predicates :hierarchy :method-preconditions)
  (:types lamp)
  (:predicates (lit ?x - lamp) (broken ?x - lamp) (dark) (only-deleted) (asked-by-method) (asked-by-goal))
  (:task brighten :parameters (?x - lamp))
  (:derived (dark) (forall (?x - lamp) (not (lit ?x))))
  (:method by-hand
    :parameters (?x - lamp)
    :task (brighten ?x)
    :precondition (asked-by-method)
    :ordered-subtasks (and (switch ?x)))
  (:action switch
    :parameters (?x - lamp)
    :effect (and (lit ?x) (not (only-deleted)))))

; A goal alone does not make it useful: nothing can change it.
(define (problem evening)
  (:domain hall)
  (:objects left - lamp)
  (:init)
  (:goal (and (lit left) (asked-by-goal))))
