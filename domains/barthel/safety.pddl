; What the Barthel test owes the patient, beyond what CLARC owes everyone.
(define (domain barthel-safety)
  (:requirements :typing :negative-preconditions :disjunctive-preconditions
                 :quantified-preconditions
                 :fluents :constraints :invariants)
  (:import clarc)
  (:constants    ; nodes of graph.pddl
    closing - phase
    farewell - remark)

  (:invariant asked-until-answered
    :parameters (?t - test ?q - question ?i - item ?o - option)
    :says (?q is not put in ?i again after the answer ?o)
    :constraint (always (imply (was_chosen_in ?o ?i) (at-most-once (= (question ?t ?i) ?q)))))

  ; A goodbye, or a clinician has come, is on the way or has taken over.
  (:invariant nobody-is-left-alone
    :says (the run ends with a goodbye, with a clinician, or with a call that stands)
    :constraint (at end (or (was_said_in farewell closing) (was_shown_in farewell closing)
                            (exists (?t - test) (is ?t aborted))
                            (exists (?c - clinician ?n - need)
                              (or (attended ?c ?n) (is_called_for ?c ?n) (is_needed_for ?c ?n))))))

  (:invariant report-is-delivered
    :parameters (?c - clinician)
    :says (?c gets the report, or it is still due)
    :constraint (at end (or (was_delivered_to report ?c) (is_owed_to report ?c)))))
