; Undoes what the auditor does.
(define (domain clerk)
  (:requirements :typing :durative-actions :agent-rules)
  (:import lab)

  (:durative-action file
    :parameters (?r - robot ?s - sentence)
    :condition (at start (said ?r ?s))
    :effect (and (at start (not (said ?r ?s))) (at start (heard ?r ?s)))))
