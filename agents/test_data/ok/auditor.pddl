; Undoes what the clerk does.
(define (domain auditor)
  (:requirements :typing :durative-actions :agent-rules)
  (:import lab)

  (:durative-action reopen
    :parameters (?r - robot ?s - sentence)
    :condition (at start (heard ?r ?s))
    :effect (and (at start (not (heard ?r ?s))) (at start (said ?r ?s)))))
