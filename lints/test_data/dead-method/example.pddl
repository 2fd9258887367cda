(define (domain hall)
  (:requirements :typing :hierarchy)
  (:types lamp)
  (:predicates (lit ?l - lamp))
  (:task evening :parameters (?l - lamp))
  (:method go-on
    :parameters (?l - lamp)
    :task (evening ?l)
    :ordered-subtasks (and (switch ?l) (evening ?l)))
  (:action switch
    :parameters (?l - lamp)
    :effect (lit ?l)))
