(define (domain hall)
  (:requirements :typing :durative-actions)
  (:types lamp)
  (:predicates (lit ?x - lamp) (broken ?x - lamp))
  (:durative-action repair
    :parameters (?x - lamp)
    :duration (= ?duration 5)
    :condition (over all (broken ?x))
    :effect (and (at start (not (broken ?x))) (at end (lit ?x)))))
