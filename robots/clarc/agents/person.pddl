; Person: the people in front of the robot, from the skeletons of their upper bodies.
;
; Who is seen is with the robot. A tracker that fails sees nobody: what it reported last holds no longer.
(define (domain person-agent)
  (:requirements :typing :negative-preconditions :fluents :durative-actions :agent-rules)
  (:import clarc)

  (:durative-action see
    :parameters (?w - world ?r - robot ?p - person ?m - room)
    :duration (<= ?duration 45)
    :condition (and
      (at start (not (is_with ?p ?r)))
      (at start (not (has_left ?p ?m)))
      (at start (is ?p patient))
      (over all (not (is tracker broken))))
    :results (?at - pose)
    :effect (and
      (at end (assign (rt ?w ?p) ?at))
      (at end (is_with ?p ?r))
      (at timeout (has_left ?p ?m))
      (at failure (is tracker broken)))
    :skill (await-person ?p))

  (:durative-action see-again
    :parameters (?w - world ?r - robot ?p - person ?m - room)
    :condition (and
      (at start (not (is_with ?p ?r)))
      (at start (has_left ?p ?m))
      (over all (not (is tracker broken))))
    :results (?at - pose)
    :effect (and
      (at end (assign (rt ?w ?p) ?at))
      (at end (not (has_left ?p ?m)))
      (at end (is_with ?p ?r))
      (at failure (is tracker broken)))
    :skill (await-person ?p))

  ; Whoever else comes: the robot does not wait for them, and does not miss them.
  (:durative-action see-visitor
    :parameters (?w - world ?r - robot ?p - person)
    :condition (and
      (at start (not (is_with ?p ?r)))
      (at start (not (is ?p patient)))
      (over all (not (is tracker broken))))
    :results (?at - pose)
    :effect (and
      (at end (assign (rt ?w ?p) ?at))
      (at end (is_with ?p ?r))
      (at failure (is tracker broken)))
    :skill (await-person ?p))

  (:durative-action lose
    :parameters (?r - robot ?p - person)
    :condition (and
      (at start (is_with ?p ?r))
      (over all (not (is tracker broken))))
    :effect (and
      (at end (not (is_with ?p ?r)))
      (at abort (not (is_with ?p ?r)))
      (at failure (not (is_with ?p ?r)))
      (at failure (is tracker broken)))
    :skill (await-loss ?p)))
