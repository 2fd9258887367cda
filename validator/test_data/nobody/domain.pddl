(define (domain nobody)
  (:requirements :adl :typing)
  (:types patient nurse)
  (:predicates (calm ?p - patient) (done))
  (:action every :parameters () :precondition (forall (?p - patient) (calm ?p)) :effect (done))
  (:action some
    :parameters ()
    :precondition (exists (?p - patient) (not (calm ?p)))
    :effect (done)))
