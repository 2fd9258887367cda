(define (domain hall)
  (:requirements :typing)
  ; Two supertypes are two supertypes, but `object` adds nothing to the other one.
  (:types desk - thing desk - place shelf - place shelf lamp - thing Lamp - thing)
  (:predicates (lit ?x - lamp) (at ?d - desk ?s - shelf))
  (:action switch :parameters (?x - lamp ?d - desk ?s - shelf) :precondition (at ?d ?s) :effect (lit ?x)))
