; Panel: the touchscreen, with its pages and touches.
(define (domain panel)
  (:requirements :typing :equality :negative-preconditions :existential-preconditions
                 :fluents :durative-actions :agent-rules)
  (:import clarc)

  (:durative-action show
    :parameters (?r - robot ?p - person ?t - test ?i - part ?u - remark)
    :duration (<= ?duration 10)
    :condition (and
      (at start (not (is ?r showing)))
      (at start (not (is screen broken)))
      (over all (is_in ?t ?i))
      (over all (= (view ?t ?i) ?u))
      (over all (is_with ?p ?r)))
    :effect (and
      (at start (not (is_not ?r showing)))
      (at start (not (finish ?r showing)))
      (at start (is ?r showing))
      (at end (not (is ?r showing)))
      (at end (finish ?r showing))
      (at end (assign (view ?t ?i) undefined))
      (at abort (not (is ?r showing)))
      (at abort (is_not ?r showing))
      (at timeout (not (is ?r showing)))
      (at timeout (is_not ?r showing))
      (at timeout (is screen broken))
      (at failure (not (is ?r showing)))
      (at failure (is_not ?r showing))
      (at failure (is screen broken)))
    :skill (show ?i ?u)
    :claims (display)
    :priority 50)

  (:durative-action show-summons
    :parameters (?r - robot ?t - test ?i - part ?u - summons)
    :duration (<= ?duration 10)
    :condition (and
      (at start (not (is ?r showing)))
      (at start (not (is screen broken)))
      (over all (is_in ?t ?i))
      (over all (= (view ?t ?i) ?u)))
    :effect (and
      (at start (not (is_not ?r showing)))
      (at start (not (finish ?r showing)))
      (at start (is ?r showing))
      (at end (not (is ?r showing)))
      (at end (finish ?r showing))
      (at end (assign (view ?t ?i) undefined))
      (at abort (not (is ?r showing)))
      (at abort (is_not ?r showing))
      (at timeout (not (is ?r showing)))
      (at timeout (is_not ?r showing))
      (at timeout (is screen broken))
      (at failure (not (is ?r showing)))
      (at failure (is_not ?r showing))
      (at failure (is screen broken)))
    :skill (show ?i ?u)
    :claims (display)
    :priority 70)

  ; A page that was sent need not be on the screen; the screen itself reports the page that it shows.
  (:durative-action see-page
    :parameters (?r - robot) ; allow(unused-parameter): it runs once for each robot
    :condition (at start (not (is screen broken)))
    :results (?u - utterance ?i - part)
    :effect (at end (was_shown_in ?u ?i))
    :skill (watch-page))

  (:durative-action touch
    :parameters (?r - robot ?p - person ?t - test ?i - item ?a - answer ?q - question)
    :condition (and
      (at start (not (is microphone broken)))
      (over all (waiting ?p ?a))
      (over all (is_in ?t ?i))
      (over all (= (question ?t ?i) ?q))
      (over all (is_with ?p ?r)))
    :results (?o - option)
    :effect (and
      (at end (not (waiting ?p ?a)))
      (at end (got ?p ?a))
      (at end (was_chosen_in ?o ?i)))
    :skill (await-touch ?i ?q))

  ; With a broken microphone, only the screen takes the answer, and this rule reports a silence.
  (:durative-action touch-alone
    :parameters (?r - robot ?p - person ?t - test ?i - item ?a - answer ?q - question)
    :duration (<= ?duration 20)
    :condition (and
      (at start (can ?p ?a))
      (at start (is microphone broken))
      (over all (not (is screen broken)))
      (over all (is_in ?t ?i))
      (over all (= (question ?t ?i) ?q))
      (over all (is_with ?p ?r))
      (over all (not (is ?t paused)))
      (over all (not (is ?t aborted)))
      (over all (waiting ?p ?a)))
    :results (?o - option)
    :effect (and
      (at start (not (can ?p ?a)))
      (at start (waiting ?p ?a))
      (at end (not (waiting ?p ?a)))
      (at end (got ?p ?a))
      (at end (was_chosen_in ?o ?i))
      (at abort (not (waiting ?p ?a)))
      (at timeout (not (waiting ?p ?a)))
      (at timeout (was_unanswered_in ?q ?i))
      (at failure (not (waiting ?p ?a)))
      (at failure (is screen broken)))
    :skill (await-touch ?i ?q)))
