(define (domain hall)
  (:requirements :typing :hierarchy)
  (:types lamp)
  (:predicates (lit ?x - lamp))
  (:task brighten
    :parameters (?x - lamp))
  (:action switch
    :parameters (?x - lamp)
    :effect (lit ?x)))
