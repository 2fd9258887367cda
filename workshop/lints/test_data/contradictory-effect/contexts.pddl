(define (domain hall)
  (:requirements :adl :durative-actions)
  (:types lamp)
  (:predicates (lit ?x - lamp) (broken ?x - lamp))
  (:action plain :parameters (?x ?y - lamp) :effect (and (not (lit ?x)) (and (lit ?x)) (lit ?y)))
  ; First all are off, then one of them is on: that is a way to say it.
  (:action all
    :parameters (?x - lamp)
    :effect (and (lit ?x) (forall (?y - lamp) (not (lit ?y))) (when (broken ?x) (not (lit ?x)))))
  (:action conditional
    :parameters (?x - lamp)
    :effect (when (broken ?x) (and (not (lit ?x)) (lit ?x))))
  (:durative-action times
    :parameters (?x - lamp)
    :duration (= ?duration 1)
    :effect (and (at start (lit ?x)) (at end (not (lit ?x))) (at end (broken ?x)) (at end (not (broken ?x))))))
