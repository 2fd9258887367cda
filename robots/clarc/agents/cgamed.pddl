; CGAmed: the clinician's side: commands from the clinician's console, calls to the clinician, and
; the report.
(define (domain cgamed)
  (:requirements :typing :negative-preconditions :durative-actions :agent-rules)
  (:import clarc)

  (:durative-action hear-pause
    :parameters (?t - test)
    :condition (and (at start (not (is ?t paused))) (at start (not (is ?t aborted))))
    :effect (at end (is ?t paused))
    :skill (await-command pause))

  (:durative-action hear-resume
    :parameters (?t - test)
    :condition (over all (is ?t paused))
    :effect (at end (not (is ?t paused)))
    :skill (await-command resume))

  (:durative-action hear-abort
    :parameters (?t - test)
    :condition (at start (not (is ?t aborted)))
    :effect (and (at end (is ?t aborted)) (at end (not (is ?t paused))))
    :skill (await-command abort))

  ; Ends when the clinician has attended to the need.
  (:durative-action call
    :parameters (?c - clinician ?n - need ?p - person)
    :condition (over all (is_needed_for ?c ?n))
    :effect (and
      (at start (is_called_for ?c ?n))
      (at end (not (is_needed_for ?c ?n)))
      (at end (not (is_called_for ?c ?n)))
      (at end (not (asks ?p help)))
      (at end (attended ?c ?n))
      (at abort (not (is_called_for ?c ?n)))
      (at failure (not (is_needed_for ?c ?n)))
      (at failure (not (is_called_for ?c ?n))))
    :skill (call-clinician ?n))

  (:durative-action deliver
    :parameters (?d - document ?c - clinician)
    :condition (over all (is_due_to ?d ?c))
    :effect (and
      (at end (not (is_due_to ?d ?c)))
      (at end (was_delivered_to ?d ?c))
      (at failure (not (is_due_to ?d ?c))))
    :skill (deliver ?d)))
