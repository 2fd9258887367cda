; A rule without a skill: it is over when it begins.
(define (domain secretary)
  (:requirements :typing :durative-actions :agent-rules)
  (:import lab)

  (:durative-action note-down
    :parameters (?r - robot ?s - sentence)
    :condition (at start (said ?r ?s))
    :effect (and (at start (not (said ?r ?s))) (at start (heard ?r ?s)))))
