(define (domain talker)
  (:requirements :typing :negative-preconditions :durative-actions :agent-rules)
  (:import lab)

  (:durative-action say
    :parameters (?r - robot ?p - person ?s - sentence)
    :duration (<= ?duration 10)
    :condition (and
      (at start (not (is ?r broken)))
      (over all (shall_say ?r ?s))
      (over all (is_with ?p ?r)))
    :effect (and
      (at start (not (is_not ?r speaking)))
      (at start (is ?r speaking))
      (at start (says ?r ?s))
      (at end (not (is ?r speaking)))
      (at end (not (says ?r ?s)))
      (at end (not (shall_say ?r ?s)))
      (at end (said ?r ?s))
      (at abort (not (is ?r speaking)))
      (at abort (is_not ?r speaking))
      (at abort (not (says ?r ?s)))
      (at timeout (not (is ?r speaking)))
      (at timeout (not (says ?r ?s)))
      (at timeout (is ?r broken)))
    :skill (say ?p ?s)
    :claims (mouth)
    :priority 50)

  ; What must keep holding is what the rule itself begins; what comes of it is a result.
  (:durative-action ask
    :parameters (?r - robot ?p - person)
    :condition (and
      (at start (shall_ask ?r ?p))
      (over all (waits_for ?r ?p)))
    :results (?s - sentence)
    :effect (and
      (at start (not (shall_ask ?r ?p)))
      (at start (waits_for ?r ?p))
      (at end (not (waits_for ?r ?p)))
      (at end (heard ?r ?s))
      (at misheard (not (waits_for ?r ?p)))
      (at misheard (missed ?r ?p))
      (at abort (not (waits_for ?r ?p))))
    :skill (listen ?p)))
