; What CLARC owes the people in front of it, whatever the test and whatever breaks.
;
; Each invariant is held in every run, every scenario and every campaign; a run that breaks one fails.
(define (domain clarc-safety)
  (:requirements :typing :negative-preconditions :disjunctive-preconditions
                 :quantified-preconditions
                 :equality :fluents :constraints :invariants)
  (:import clarc)

  ; ---- help ----------------------------------------------------------------------------------
  ; A request ends with the call that answers it, so this holds until a clinician has come. A console
  ; that is known to be broken, or to reject calls, cannot be called: then the call is due.
  (:invariant help-is-acted-upon
    :parameters (?p - person)
    :says (while ?p asks for help the clinician is called, within two seconds and without a longer
                 pause)
    :constraint (always-within 2 (asks ?p help)
                               (exists (?c - clinician ?n - need)
                                 (or
                                   (is_called_for ?c ?n)
                                   (and (is_needed_for ?c ?n)
                                        (or (is console broken) (is console doubted)))))))

  (:invariant call-stands
    :parameters (?c - clinician ?n - need)
    :says (a call of ?c for ?n is attended, or stands in the end)
    :constraint (always (imply (is_called_for ?c ?n)
                               (sometime (or (attended ?c ?n)
                                             (at end (or
                                                       (is_called_for ?c ?n)
                                                       (is_needed_for ?c ?n))))))))

  ; A call that fails at once is repeated after 1, 2, 4 … 30 seconds, as every rule is.
  (:invariant call-is-repeated
    :parameters (?c - clinician ?n - need)
    :says (while ?c is needed for ?n a call is under way but for half a minute)
    :constraint (always-within 31 (and (is_needed_for ?c ?n) (not (is console broken)))
                               (or (is_called_for ?c ?n) (is console broken) (attended ?c ?n))))

  ; ---- speaking ------------------------------------------------------------------------------
  (:invariant spoken-to-who-is-there
    :parameters (?r - robot ?t - test ?i - part ?u - remark)
    :says (?u is not said in ?i unless the patient of ?t is there)
    :constraint (always (imply (and (is ?r speaking) (is_in ?t ?i) (= (label ?t ?i) ?u))
                               (exists (?p - person) (and (is ?p patient) (is_with ?p ?r))))))

  (:invariant silent-while-paused
    :parameters (?r - robot ?t - test ?i - part ?u - remark)
    :says (?u is not said in ?i while ?t is paused or after it was aborted)
    :constraint (always (imply (and (is ?r speaking) (is_in ?t ?i) (= (label ?t ?i) ?u))
                               (and (not (is ?t paused)) (not (is ?t aborted))))))

  ; ---- questions and answers -----------------------------------------------------------------
  (:invariant silence-is-fair
    :parameters (?q - question ?i - item)
    :says (?q in ?i counts as unanswered only after it was said or shown)
    :constraint
      (sometime-before (was_unanswered_in ?q ?i) (or (was_said_in ?q ?i) (was_shown_in ?q ?i))))

  (:invariant sensed-what-was-told
    :parameters (?u - utterance ?i - part)
    :says (?u in ?i is sensed only if it is said or shown)
    :constraint
      (always (imply (was_sensed_in ?u ?i) (or (was_said_in ?u ?i) (was_shown_in ?u ?i)))))

  (:invariant answered-once
    :parameters (?i - item)
    :says (?i is answered at most once)
    :constraint (and
      (at-most-once (exists (?o - option) (was_chosen_in ?o ?i)))
      (always (not (exists (?o ?u - option)
                     (and (was_chosen_in ?o ?i) (was_chosen_in ?u ?i) (not (= ?o ?u))))))))

  ; ---- the end -------------------------------------------------------------------------------
  (:invariant nothing-left-behind
    :parameters (?r - robot ?p - person)
    :says (in the end ?r neither speaks nor shows nor waits for ?p to answer, unless it is calling)
    :constraint (at end (or
                          (exists (?c - clinician ?n - need)
                            (or (is_called_for ?c ?n) (is_needed_for ?c ?n)))
                          (and (not (is ?r speaking)) (not (is ?r showing))
                               (not (waiting ?p answer)) (not (can ?p answer)))))))
