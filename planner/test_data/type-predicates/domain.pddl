(define (domain post)
  (:requirements :adl :typing)
  (:types letter parcel - item item van - thing place)
  (:predicates (at ?x - thing ?p - place) (in ?i - item) (stamped ?i - item))
  (:action drive
    :parameters (?v - thing ?from ?to - place)
    :precondition (and (van ?v) (at ?v ?from))
    :effect (and (not (at ?v ?from)) (at ?v ?to)))
  (:action load
    :parameters (?i - item ?v - van ?p - place)
    :precondition (and (at ?i ?p) (at ?v ?p) (imply (letter ?i) (stamped ?i)))
    :effect (and (in ?i) (not (at ?i ?p))))
  (:action stamp
    :parameters (?i - item)
    :precondition (not (parcel ?i))
    :effect (forall (?j - item) (when (and (letter ?j) (= ?j ?i)) (stamped ?j)))))
