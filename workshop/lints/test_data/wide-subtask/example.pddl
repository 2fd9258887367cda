(define (domain hall)
  (:requirements :typing :hierarchy)
  (:types lamp - thing)
  (:predicates (lit ?x - lamp) (clean ?x - thing))
  (:task tidy
    :parameters (?x - thing))
  (:method in-order
    :parameters (?x - thing)
    :task (tidy ?x)
    :ordered-subtasks (and (wipe ?x) (switch ?x)))
  (:action wipe
    :parameters (?x - thing)
    :effect (clean ?x))
  (:action switch
    :parameters (?x - lamp)
    :effect (lit ?x)))
