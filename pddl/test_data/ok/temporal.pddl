; a predicate called at, two blanks, durations in every form, forall around a time
(define (domain drive)
  (:requirements :typing :durative-actions :duration-inequalities :numeric-fluents)
  (:types car place)
  (:predicates (at ?c - car ?p - place) (free ?p - place) (tuned ?c - car))
  (:functions (far ?a ?b - place) (speed ?c - car))
  (:durative-action drive
    :parameters (?c - car ?a ?b - place)
    :duration (= ?duration (/ (far ?a ?b) (speed ?c)))
    :condition (and (at  start (at ?c ?a)) (over all (free ?b)) (at end (>= (speed ?c) ?duration))
                    (forall (?d - car) (and (at start (tuned ?d)) (over all (tuned ?d)))))
    :effect (and (at start (not (at ?c ?a))) (at end (at ?c ?b))
                 (forall (?d - car) (at end (when (tuned ?d) (not (tuned ?d)))))
                 (when (at start (tuned ?c)) (at start (increase (speed ?c) 1)))))
  (:durative-action tune
    :parameters (?c - car)
    :duration (and (>= ?duration 1) (at start (<= ?duration 5)))
    :effect (at end (tuned ?c)))
  (:durative-action wait :parameters () :duration ()))
