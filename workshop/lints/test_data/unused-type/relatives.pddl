(define (domain hall)
  (:requirements :typing)
  (:types lamp thing room place - object desk-lamp - lamp chair - thing hall - room)
  (:constants here - place)
  (:predicates (lit ?x - lamp))
  (:action switch
    :parameters (?x - lamp)
    :effect (lit ?x)))
