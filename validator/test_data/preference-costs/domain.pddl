(define (domain guests)
  (:requirements :typing :durative-actions :preferences :constraints :negative-preconditions
                 :numeric-fluents)
  (:types guest)
  (:predicates (served ?g - guest) (asked ?g - guest) (quiet) (warm))
  (:action ask :parameters (?g - guest) :precondition () :effect (asked ?g))
  (:action serve
    :parameters (?g - guest)
    :precondition (preference polite (asked ?g))
    :effect (served ?g))
  (:action shout :parameters () :precondition () :effect (not (quiet)))
  (:action hush :parameters () :precondition () :effect (quiet))
  (:durative-action dine
    :parameters (?g - guest)
    :duration (= ?duration 3)
    :condition (and
      (preference calm (over all (quiet)))
      (preference heated (at end (warm)))
      (at start (asked ?g)))
    :effect (at end (served ?g))))
