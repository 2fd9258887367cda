; A rule that takes the mouth as soon as another one uses it, and so undoes its own condition.
(define (domain heckler)
  (:requirements :typing :durative-actions :agent-rules)
  (:import lab)

  (:durative-action heckle
    :parameters (?r - robot)
    :condition (over all (is ?r speaking))
    :effect (at end (is ?r quiet))
    :skill (await-loss)
    :claims (mouth)
    :priority 100))
