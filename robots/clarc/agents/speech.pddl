; Speech: text to speech, and spoken answers.
;
; A rule gives the graph before (conditions at start), the graph during (effects at start), and the
; condition that must hold meanwhile (over all), or the skill is stopped in the same commit. Then it
; gives the graph after, for each outcome: `end` when the skill succeeds, `abort` when a reflex stops
; it, `timeout` when the duration is over, and the skill's own outcomes.
;
; The loudspeaker is heard by the microphone. What it did not hear was not said (`unsensed`): one of the
; two does not do what it claims. Without a microphone the loudspeaker is believed, and the report says so.
(define (domain speech)
  (:requirements :typing :equality :negative-preconditions :existential-preconditions
                 :conditional-effects :fluents :durative-actions :agent-rules)
  (:import clarc)

  (:durative-action say
    :parameters (?r - robot ?p - person ?t - test ?i - part ?u - remark)
    :duration (<= ?duration 60)
    :condition (and
      (at start (not (is ?r speaking)))
      (at start (not (is speaker doubted)))
      (at start (not (refuses speaker ?i)))
      (over all (not (is speaker broken)))
      (over all (is_in ?t ?i))
      (over all (= (label ?t ?i) ?u))
      (over all (is ?p patient))
      (over all (is_with ?p ?r))
      (over all (not (is ?t paused)))
      (over all (not (is ?t aborted))))
    :effect (and
      (at start (not (is_not ?r speaking)))
      (at start (not (finish ?r speaking)))
      (at start (is ?r speaking))
      (at end (not (is ?r speaking)))
      (at end (finish ?r speaking))
      (at end (was_said_in ?u ?i))
      (at end (was_sensed_in ?u ?i))
      (at end (when (not (= (view ?t ?i) ?u)) (was_told_in ?u ?i)))
      (at end (assign (label ?t ?i) undefined))
      (at claimed (not (is ?r speaking)))
      (at claimed (finish ?r speaking))
      (at claimed (was_said_in ?u ?i))
      (at claimed (when (not (= (view ?t ?i) ?u)) (was_told_in ?u ?i)))
      (at claimed (assign (label ?t ?i) undefined))
      (at abort (not (is ?r speaking)))
      (at abort (is_not ?r speaking))
      (at unsensed (not (is ?r speaking)))
      (at unsensed (is_not ?r speaking))
      (at unsensed (is speaker doubted))
      (at unsensed (is microphone doubted))
      (at refused (not (is ?r speaking)))
      (at refused (is_not ?r speaking))
      (at refused (refuses speaker ?i))
      (at timeout (not (is ?r speaking)))
      (at timeout (is_not ?r speaking))
      (at timeout (is speaker doubted))
      (at failure (not (is ?r speaking)))
      (at failure (is_not ?r speaking))
      (at failure (is speaker broken)))
    :skill (say ?i ?u)
    :claims (loudspeaker)
    :priority 50)

  (:durative-action call-out
    :parameters (?r - robot ?t - test ?i - part ?u - summons)
    :duration (<= ?duration 60)
    :condition (and
      (at start (not (is ?r speaking)))
      (at start (not (refuses speaker ?i)))
      (over all (not (is speaker broken)))
      (over all (is_in ?t ?i))
      (over all (= (label ?t ?i) ?u)))
    :effect (and
      (at start (not (is_not ?r speaking)))
      (at start (not (finish ?r speaking)))
      (at start (is ?r speaking))
      (at end (not (is ?r speaking)))
      (at end (finish ?r speaking))
      (at end (was_said_in ?u ?i))
      (at end (was_sensed_in ?u ?i))
      (at end (when (not (= (view ?t ?i) ?u)) (was_told_in ?u ?i)))
      (at end (assign (label ?t ?i) undefined))
      (at claimed (not (is ?r speaking)))
      (at claimed (finish ?r speaking))
      (at claimed (was_said_in ?u ?i))
      (at claimed (when (not (= (view ?t ?i) ?u)) (was_told_in ?u ?i)))
      (at claimed (assign (label ?t ?i) undefined))
      (at abort (not (is ?r speaking)))
      (at abort (is_not ?r speaking))
      (at unsensed (not (is ?r speaking)))
      (at unsensed (is_not ?r speaking))
      (at unsensed (assign (label ?t ?i) undefined))
      (at unsensed (is speaker doubted))
      (at unsensed (is microphone doubted))
      (at refused (not (is ?r speaking)))
      (at refused (is_not ?r speaking))
      (at refused (refuses speaker ?i))
      (at timeout (not (is ?r speaking)))
      (at timeout (is_not ?r speaking))
      (at timeout (is speaker doubted))
      (at failure (not (is ?r speaking)))
      (at failure (is_not ?r speaking))
      (at failure (is speaker broken)))
    :skill (say ?i ?u)
    :claims (loudspeaker)
    :priority 70)

  ; An answer may be spoken or touched. This rule starts to listen, and the panel's rule `touch` waits
  ; for the same `waiting`; the first to end stops the other. A broken microphone is reported as broken,
  ; not as a silence of the person. A silence may be that of an empty chair: the tracker is tested.
  (:durative-action hear
    :parameters (?r - robot ?p - person ?t - test ?i - item ?a - answer ?q - question)
    :duration (<= ?duration 15)
    :condition (and
      (at start (can ?p ?a))
      (at start (not (is microphone doubted)))
      (over all (not (is microphone broken)))
      (over all (is_in ?t ?i))
      (over all (= (question ?t ?i) ?q))
      (over all (is ?p patient))
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
      (at timeout (is tracker doubted))
      (at misheard (not (waiting ?p ?a)))
      (at misheard (was_misheard_in ?q ?i))
      (at misheard (was_unanswered_in ?q ?i))
      (at failure (not (waiting ?p ?a)))
      (at failure (is microphone broken)))
    :skill (listen ?i ?q)
    :claims (turn)
    :priority 20)

  ; A question that an interruption has closed is still being asked: it is listened for again.
  (:durative-action listen-again
    :parameters (?r - robot ?p - person ?t - test ?i - item ?a - answer ?q - question)
    :condition (and
      (at start (not (is microphone broken)))
      (at start (not (is microphone doubted)))
      (at start (is_in ?t ?i))
      (at start (= (question ?t ?i) ?q))
      (at start (is ?p patient))
      (at start (is_with ?p ?r))
      (at start (not (is ?t paused)))
      (at start (not (is ?t aborted)))
      (at start (not (can ?p ?a)))
      (at start (not (waiting ?p ?a)))
      (at start (not (got ?p ?a)))
      (at start (not (was_unanswered_in ?q ?i))))
    :effect (at start (can ?p ?a)))

  ; A request is heard wherever the person is: a voice needs no view.
  (:durative-action hear-request
    :parameters (?p - person ?q - request)
    :condition (and
      (at start (not (asks ?p ?q)))
      (over all (not (is microphone broken))))
    :effect (and
      (at end (asks ?p ?q))
      (at failure (is microphone broken)))
    :skill (spot ?q ?p))

  ; ---- what an agent that is gone has left behind ------------------------------------------
  ; Who speaks holds the loudspeaker: while it is free, nobody speaks.
  (:durative-action fall-silent
    :parameters (?r - robot)
    :duration (<= ?duration 0.1)
    :condition (over all (is ?r speaking))
    :effect (and (at timeout (not (is ?r speaking))) (at timeout (is_not ?r speaking)))
    :skill (wait)
    :claims (loudspeaker))

  ; Who waits for an answer holds the turn.
  (:durative-action stop-waiting
    :parameters (?p - person ?a - answer)
    :duration (<= ?duration 0.1)
    :condition (over all (waiting ?p ?a))
    :effect (at timeout (not (waiting ?p ?a)))
    :skill (wait)
    :claims (turn))

  ; An offer that nobody takes up is none.
  (:durative-action close-offer
    :parameters (?p - person ?a - answer)
    :duration (<= ?duration 1)
    :condition (over all (can ?p ?a))
    :effect (at timeout (not (can ?p ?a)))
    :skill (wait)))
