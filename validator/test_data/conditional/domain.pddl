(define (domain lamps)
  (:requirements :adl)
  (:types lamp switch)
  (:predicates (on ?l - lamp) (wired ?s - switch ?l - lamp) (power) (checked) (broken ?l - lamp))
  (:action flip
    :parameters (?s - switch)
    :effect (forall (?l - lamp)
              (and
                (when (and (wired ?s ?l) (not (on ?l)) (power)) (on ?l))
                (when (and (wired ?s ?l) (on ?l)) (not (on ?l))))))
  (:action connect :parameters () :precondition (not (power)) :effect (power))
  (:action check
    :parameters ()
    :precondition (forall (?l - lamp) (or (on ?l) (broken ?l)))
    :effect (checked))
  (:action report
    :parameters ()
    :precondition (exists (?l - lamp ?s - switch) (and (broken ?l) (wired ?s ?l)))
    :effect (checked))
  (:action leave
    :parameters ()
    :precondition (imply (power) (not (exists (?l - lamp) (on ?l))))
    :effect (and (checked) (forall (?l - lamp) (not (on ?l))))))
