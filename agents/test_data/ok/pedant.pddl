; A rule that takes the mouth, and whose own beginning breaks its condition over all while the robot must be quiet.
(define (domain pedant)
  (:requirements :typing :negative-preconditions :disjunctive-preconditions :durative-actions :agent-rules)
  (:import lab)

  (:durative-action lecture
    :parameters (?r - robot ?s - sentence)
    :condition (and
      (at start (shall_shout ?r ?s))
      (over all (not (and (is ?r quiet) (heard ?r ?s)))))
    :effect (and
      (at start (heard ?r ?s))
      (at end (not (shall_shout ?r ?s)))
      (at end (not (heard ?r ?s)))
      (at abort (not (heard ?r ?s))))
    :skill (say ?r ?s)
    :claims (mouth)
    :priority 100))
