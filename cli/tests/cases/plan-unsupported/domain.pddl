(define (domain tank)
  (:requirements :strips :durative-actions)
  (:predicates (full))
  (:durative-action pour :parameters () :duration (= ?duration 3) :condition (and) :effect (at end (full))))
