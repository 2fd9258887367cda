; CGAmed: the clinician's side: commands from the clinician's console, calls to the clinician, and
; the report.
;
; Who asks for help is answered here, with no plan in between. What a clinician is needed for stays needed
; until one has attended to it, whoever wanted it and whatever became of them: the call is repeated when the
; link fails or nobody comes, and then it is urgent.
(define (domain cgamed)
  (:requirements :typing :equality :negative-preconditions :disjunctive-preconditions
                 :universal-preconditions :conditional-effects :durative-actions :agent-rules)
  (:import clarc)

  (:durative-action hear-pause
    :parameters (?t - test)    ; waive(failure): the command is awaited again; the agent `health` reports the link
    :condition (and (at start (not (is ?t paused))) (at start (not (is ?t aborted))))
    :effect (at end (is ?t paused))
    :skill (await-command pause))

  (:durative-action hear-resume
    :parameters (?t - test)    ; waive(failure): the command is awaited again; the agent `health` reports the link
    :condition (over all (is ?t paused))
    :effect (at end (not (is ?t paused)))
    :skill (await-command resume))

  (:durative-action hear-abort
    :parameters (?t - test)    ; waive(failure): the command is awaited again; the agent `health` reports the link
    :condition (at start (not (is ?t aborted)))
    :effect (and (at end (is ?t aborted)) (at end (not (is ?t paused))))
    :skill (await-command abort))

  (:durative-action answer-help
    :parameters (?c - clinician ?p - person)
    :condition (and
      (at start (asks ?p help))
      (at start (not (is_needed_for ?c assistance))))
    :effect (at start (is_needed_for ?c assistance)))

  ; PELEA may withdraw what it wants. What is needed is not withdrawn.
  (:durative-action note-need
    :parameters (?c - clinician ?n - need)
    :condition (and
      (at start (is_wanted_for ?c ?n))
      (at start (not (attended ?c ?n)))
      (at start (not (is_needed_for ?c ?n))))
    :effect (at start (is_needed_for ?c ?n)))

  ; A call that nobody makes is the trace of an agent that is gone, or of a robot that was started again. It is
  ; made: rather once too often.
  (:durative-action note-call
    :parameters (?c - clinician ?n - need)
    :condition (and
      (at start (is_called_for ?c ?n))
      (at start (not (is_needed_for ?c ?n))))
    :effect (at start (is_needed_for ?c ?n)))

  ; A call is under way until a clinician has attended to it, however long that takes; `call-urgently`
  ; calls whoever else can come, beside it.
  (:durative-action call
    :parameters (?c - clinician ?n - need)
    :condition (and
      (at start (is_needed_for ?c ?n))
      (over all (is_called_for ?c ?n)))
    :effect (and
      (at start (is_called_for ?c ?n))
      (at end (not (is console doubted)))
      (at end (not (is_wanted_for ?c ?n)))
      (at end (not (is_needed_for ?c ?n)))
      (at end (not (is_called_for ?c ?n)))
      (at end (not (is_overdue_for ?c ?n)))
      (at end (forall (?p - person) (not (asks ?p help))))
      (at end (attended ?c ?n))
      (at failure (not (is_called_for ?c ?n)))
      (at failure (is console doubted)))
    :skill (call-clinician ?n))

  (:durative-action find-overdue
    :parameters (?c - clinician ?n - need)
    :duration (<= ?duration 120)
    :condition (and
      (at start (not (is_overdue_for ?c ?n)))
      (over all (is_called_for ?c ?n)))
    :effect (at timeout (is_overdue_for ?c ?n))
    :skill (wait))

  (:durative-action call-urgently
    :parameters (?c - clinician ?n - need)    ; waive(failure): the first call stands, this one is repeated
    :condition (and
      (at start (is_overdue_for ?c ?n))
      (over all (is_called_for ?c ?n)))
    :effect (and
      (at end (not (is console doubted)))
      (at end (not (is_wanted_for ?c ?n)))
      (at end (not (is_needed_for ?c ?n)))
      (at end (not (is_called_for ?c ?n)))
      (at end (not (is_overdue_for ?c ?n)))
      (at end (forall (?p - person) (not (asks ?p help))))
      (at end (attended ?c ?n)))
    :skill (call-clinician ?n urgent))

  ; A robot that has been blind, or that a person cannot reach or hear, for five seconds.
  (:durative-action call-for-repair
    :parameters (?c - clinician)
    :duration (<= ?duration 5)
    :condition (and
      (at start (not (is_needed_for ?c repair)))
      (at start (not (is_called_for ?c repair)))
      (at start (not (attended ?c repair)))
      (over all (or
                  (is tracker broken)
                  (is tracker doubted)
                  (and (or (is microphone broken) (is microphone doubted))
                       (or (is touch broken) (is screen broken) (is screen doubted)))
                  (and (or (is speaker broken) (is speaker doubted))
                       (or (is screen broken) (is screen doubted))))))
    :effect (at timeout (is_needed_for ?c repair))
    :skill (wait))

  ; What was repaired may break again.
  (:durative-action note-repair
    :parameters (?c - clinician)
    :duration (<= ?duration 5)
    :condition (and
      (at start (attended ?c repair))
      (over all (not (or
                       (is tracker broken)
                       (is tracker doubted)
                       (and (or (is microphone broken) (is microphone doubted))
                            (or (is touch broken) (is screen broken) (is screen doubted)))
                       (and (or (is speaker broken) (is speaker doubted))
                            (or (is screen broken) (is screen doubted)))))))
    :effect (at timeout (not (attended ?c repair)))
    :skill (wait))

  ; What was due once is delivered, whatever becomes of who wanted it.
  (:durative-action note-debt
    :parameters (?d - document ?c - clinician)
    :condition (and
      (at start (is_due_to ?d ?c))
      (at start (not (is_owed_to ?d ?c))))
    :effect (at start (is_owed_to ?d ?c)))

  (:durative-action deliver
    :parameters (?d - document ?c - clinician)
    :condition (over all (is_owed_to ?d ?c))
    :effect (and
      (at end (not (is console doubted)))
      (at end (not (is_due_to ?d ?c)))
      (at end (not (is_owed_to ?d ?c)))
      (at end (was_delivered_to ?d ?c))
      (at failure (is console doubted)))
    :skill (deliver ?d)))
