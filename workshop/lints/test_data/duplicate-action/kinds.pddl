(define (domain hall)
  (:requirements :typing :durative-actions)
  (:types lamp room)
  (:predicates (lit ?x - lamp) (broken ?x - lamp) (dark ?r - room))
  (:action a :parameters (?x - lamp ?y - lamp) :precondition (and (lit ?x) (broken ?y)) :effect (lit ?y))
  (:action b :parameters (?p - lamp ?q - lamp) :precondition (and (broken ?q) (lit ?p)) :effect (and (lit ?q)))
  ; The same in another order.
  (:action c :parameters (?p - lamp ?q - lamp) :precondition (and (broken ?p) (lit ?q)) :effect (lit ?p))
  ; Not the same: which one is lit, and what it is.
  (:action h :parameters (?p - lamp ?q - lamp) :precondition (and (broken ?p) (lit ?q)) :effect (not (lit ?q)))
  (:action d :parameters (?r - room) :precondition (dark ?r) :effect (not (dark ?r)))
  (:durative-action e
    :parameters (?x - lamp)
    :duration (= ?duration 2)
    :condition (at start (broken ?x))
    :effect (at end (lit ?x)))
  (:durative-action f
    :parameters (?y - lamp)
    :duration (= ?duration 2)
    :condition (at start (broken ?y))
    :effect (at end (lit ?y)))
  (:durative-action g
    :parameters (?x - lamp)
    :duration (= ?duration 3)
    :condition (at start (broken ?x))
    :effect (at end (lit ?x))))
