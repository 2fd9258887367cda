; Health: which devices can be relied on, as far as the robot can sense it.
;
; What broke is used again as soon as it is well, and a doubt does not last: it is tested, or it fades.
(define (domain health)
  (:requirements :typing :equality :negative-preconditions :durative-actions :agent-rules)
  (:import clarc)

  (:durative-action find-broken
    :parameters (?d - device)    ; waive(failure): a device that cannot report its faults is asked again
    :condition (over all (not (is ?d broken)))
    :effect (at end (is ?d broken))
    :skill (await-fault ?d))

  (:durative-action find-working
    :parameters (?d - device)    ; waive(failure): it stays broken, and is tried again
    :condition (and (at start (not (is ?d unsteady))) (over all (is ?d broken)))
    :effect (and
      (at end (not (is ?d broken)))
      (at end (not (is ?d doubted)))
      (at end (is ?d unsteady)))
    :skill (await-recovery ?d))

  ; What broke again within a minute must be well for longer: who relies on it begins anew each time it breaks.
  (:durative-action find-steady
    :parameters (?d - device)    ; waive(failure): it stays broken, and is tried again
    :condition (and (over all (is ?d unsteady)) (over all (is ?d broken)))
    :effect (and
      (at end (not (is ?d broken)))
      (at end (not (is ?d doubted))))
    :skill (await-recovery ?d unsteady))

  (:durative-action trust-again
    :parameters (?d - device)
    :duration (<= ?duration 60)
    :condition (and (over all (is ?d unsteady)) (over all (not (is ?d broken))))
    :effect (at timeout (not (is ?d unsteady)))
    :skill (wait))

  ; A test that fails is repeated, less and less often.
  (:durative-action clear-doubt
    :parameters (?d - device)    ; waive(failure): the doubt stays, and is tested again
    :condition (and (over all (is ?d doubted)) (over all (not (is ?d broken))))
    :effect (at end (not (is ?d doubted)))
    :skill (test-device ?d))

  ; A doubt that no test can clear fades, so that the device is tried again. The console is tried however doubted.
  (:durative-action forget-doubt
    :parameters (?d - device)
    :duration (<= ?duration 300)
    :condition (and (at start (not (= ?d console))) (over all (is ?d doubted)))
    :effect (at timeout (not (is ?d doubted)))
    :skill (wait)))
