; Person: the person in front of the robot, from the skeleton of the upper body.
(define (domain person-agent)
  (:requirements :typing :negative-preconditions :fluents :durative-actions :agent-rules)
  (:import clarc)

  (:durative-action see
    :parameters (?w - world ?r - robot ?p - person ?m - room)
    :duration (<= ?duration 45)
    :condition (and
      (at start (not (is_with ?p ?r)))
      (at start (not (has_left ?p ?m))))
    :results (?at - pose)
    :effect (and
      (at end (assign (rt ?w ?p) ?at))
      (at end (is_with ?p ?r))
      (at timeout (has_left ?p ?m)))
    :skill (await-person ?p))

  (:durative-action see-again
    :parameters (?w - world ?r - robot ?p - person ?m - room)
    :condition (and
      (at start (not (is_with ?p ?r)))
      (at start (has_left ?p ?m)))
    :results (?at - pose)
    :effect (and
      (at end (assign (rt ?w ?p) ?at))
      (at end (not (has_left ?p ?m)))
      (at end (is_with ?p ?r)))
    :skill (await-person ?p))

  (:durative-action lose
    :parameters (?r - robot ?p - person)
    :condition (at start (is_with ?p ?r))
    :effect (at end (not (is_with ?p ?r)))
    :skill (await-loss ?p)))
