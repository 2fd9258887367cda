; To greet by voice and to show the menu have nothing to do with each other, so they run together. A question is asked at
; most twice: how often it was asked in vain is counted in the graph.
(define (domain menu)
  (:requirements :strips :typing :negative-preconditions :fluents :durative-actions :duration-inequalities)
  (:types person item)
  (:predicates
    (present ?p - person)       ; allow(never-true-predicate): perception alone changes it
    (talking)                   ; while the voice is in use
    (greeted ?p - person)
    (informed ?p - person)
    (served ?i - item))
  (:functions
    (silences ?i - item) - number)
  (:durative-action greet
    :parameters (?p - person)
    :duration (and (>= ?duration 1) (<= ?duration 20))
    :condition (and (over all (present ?p)) (at start (not (talking))))
    :effect (and (at start (talking)) (at end (not (talking))) (at end (greeted ?p))))
  (:durative-action inform
    :parameters (?p - person)
    :duration (and (>= ?duration 1) (<= ?duration 30))
    :condition (over all (present ?p))
    :effect (at end (informed ?p)))
  (:durative-action ask
    :parameters (?p - person ?i - item)
    :duration (and (>= ?duration 2) (<= ?duration 60))
    :condition (and
      (over all (present ?p)) (at start (greeted ?p)) (at start (informed ?p))
      (at start (< (silences ?i) 2)))
    :effect (at end (served ?i)))
  (:action pass-over
    :parameters (?i - item)
    :precondition (>= (silences ?i) 2)
    :effect (served ?i)))
