(define (domain voice)
  (:requirements :typing :negative-preconditions :fluents :durative-actions :agent-rules)
  (:import waiter)
  (:durative-action say
    :parameters (?r - robot ?t - test ?p - part ?u - utterance)
    :condition (over all (= (label ?t ?p) ?u))
    :effect (and
      (at start (is ?r speaking))
      (at end (not (is ?r speaking)))
      (at end (was_said_in ?u ?p))
      (at end (assign (label ?t ?p) undefined))
      (at abort (not (is ?r speaking))))
    ; waive(claimed, unsensed, refused, failure): it is said again until PELEA's deadline
    :skill (say ?p ?u)
    :claims (loudspeaker)
    :priority 50)
  (:durative-action hear
    :parameters (?r - robot ?p - person ?t - test ?i - item ?q - question)
    :duration (<= ?duration 10)
    :condition (and (over all (= (question ?t ?i) ?q)) (over all (is_with ?p ?r)))
    :results (?o - option)
    :effect (and
      (at end (has_ordered ?p ?i))
      (at end (was_chosen_in ?o ?i))
      (at end (assign (question ?t ?i) undefined))
      (at timeout (was_unanswered_in ?q ?i))
      (at timeout (increase (silences_in ?i) 1))
      (at timeout (assign (question ?t ?i) undefined)))
    ; waive(misheard, failure): the question is asked again after the timeout
    :skill (listen ?i ?q)))
