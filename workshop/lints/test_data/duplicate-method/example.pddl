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
  (:method by-foot
    :parameters (?x - lamp)
    :task (brighten ?x)
    :ordered-subtasks (switch ?x))
  (:action switch
    :parameters (?x - lamp)
    :effect (lit ?x)))
