(define (domain panel)
  (:requirements :typing :negative-preconditions :fluents :durative-actions :agent-rules)
  (:import waiter)
  (:durative-action show
    :parameters (?r - robot ?t - test ?p - part ?u - utterance)
    :condition (over all (= (view ?t ?p) ?u))
    :effect (and
      (at start (is ?r showing))
      (at end (not (is ?r showing)))
      (at end (was_shown_in ?u ?p))
      (at end (assign (view ?t ?p) undefined))
      (at abort (not (is ?r showing))))
    ; waive(claimed, unsensed, refused, failure): it is shown again until PELEA's deadline
    :skill (show ?p ?u)
    :claims (display)
    :priority 50))
