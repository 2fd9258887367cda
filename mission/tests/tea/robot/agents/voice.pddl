(define (domain voice)
  (:requirements :typing :negative-preconditions :fluents :durative-actions :agent-rules)
  (:import waiter)
  (:durative-action say
    :parameters (?r - robot ?t - test ?p - part ?u - utterance)
    :condition (over all (= (label ?t ?p) ?u))
    :effect (and (at start (is ?r speaking)) (at end (not (is ?r speaking))) (at end (was_said_in ?u ?p))
      (at end (assign (label ?t ?p) undefined)) (at abort (not (is ?r speaking))))
    :skill (say ?p ?u)
    :claims (loudspeaker)
    :priority 50)
  (:durative-action hear
    :parameters (?t - test ?i - item ?q - question)
    :condition (over all (= (label ?t ?i) ?q))
    ; waive(misheard): an order that was misheard is asked for again
    :results (?o - option)
    :effect (and (at end (was_chosen_in ?o ?i)) (at timeout (was_unanswered_in ?q ?i))
      (at end (assign (label ?t ?i) undefined)))
    :skill (listen ?i)))
