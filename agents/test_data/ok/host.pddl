; A rule whose beginning writes an edge through the attribute that it carries, and only while the robot is quiet.
(define (domain host)
  (:requirements :typing :fluents :negative-preconditions :conditional-effects :durative-actions :agent-rules)
  (:import lab)
  (:constants hello - sentence)

  (:durative-action greet
    :parameters (?r - robot ?p - person)
    :condition (and
      (at start (shall_ask ?r ?p))
      (over all (not (= (likes ?r ?p) hello))))
    :effect (and
      (at start (when (is ?r quiet) (assign (likes ?r ?p) hello)))
      (at end (not (shall_ask ?r ?p))))
    :skill (say ?p ?p)))
