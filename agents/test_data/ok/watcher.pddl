(define (domain watcher)
  (:requirements :typing :negative-preconditions :fluents :durative-actions :agent-rules)
  (:import lab)

  (:durative-action see
    :parameters (?w - world ?r - robot ?p - person)
    :condition (at start (not (is_with ?p ?r)))
    :results (?at - pose)
    :effect (and
      (at end (assign (rt ?w ?p) ?at))
      (at end (is_with ?p ?r)))
    :skill (await-person ?p))

  (:durative-action lose
    :parameters (?r - robot ?p - person)
    :condition (at start (is_with ?p ?r))
    :effect (at end (not (is_with ?p ?r)))
    :skill (await-loss ?p)))
