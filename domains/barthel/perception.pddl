; LowToHigh: the plan's predicates, derived from the tokens of the graph.
;
; A sentence is told once it was said, shown, or both, as the methods chose, and nothing of it is still
; to come. A device that works again later does not make it untold.
(define (domain barthel-perception)
  (:requirements :typing :equality :negative-preconditions :disjunctive-preconditions
                 :quantified-preconditions :derived-predicates)
  (:import clarc barthel)
  (:constants    ; nodes of graph.pddl
    opening - phase
    greeting explanation introduction moving-on farewell - remark
    first-question second-question - question)
  (:predicates
    (unusable ?d - device)
    (told ?u - utterance ?i - part)
    (answered ?i - item))

  (:derived (unusable ?d - device)
    (or (is ?d broken) (is ?d doubted)))

  ; Two tokens say so: one that is wrong deceives nobody.
  (:derived (told ?u - utterance ?i - part)
    (and (was_told_in ?u ?i) (or (was_said_in ?u ?i) (was_shown_in ?u ?i))))

  (:derived (answered ?i - item)
    (exists (?o - option) (was_chosen_in ?o ?i)))

  ; the person and the session
  (:derived (present ?p - person)
    (exists (?r - robot) (is_with ?p ?r)))
  (:derived (away ?p - person)
    (exists (?m - room) (has_left ?p ?m)))
  ; Blind at once; in doubt about it, mute or deaf and blank only once the clinician has been called about it.
  (:derived (impaired ?p - person)
    (or (and (is tracker broken)
             (not (exists (?c - clinician) (attended ?c repair))))
        (exists (?c - clinician)
          (and (or (is_needed_for ?c repair) (is_called_for ?c repair))
               (or (is tracker doubted)
                   (and (unusable microphone) (or (unusable touch) (unusable screen)))
                   (and (unusable speaker) (unusable screen)))))))
  (:derived (calling ?p - person)
    (exists (?c - clinician) (or (is_needed_for ?c assistance) (is_called_for ?c assistance))))
  (:derived (wants-help ?p - person)
    (asks ?p help))
  (:derived (clinician-needed ?p - person)
    (and (exists (?i ?j - item)
           (and (not (= ?i ?j)) (unanswered-twice ?i) (unanswered-twice ?j)))
         (not (exists (?c - clinician) (attended ?c unanswered)))))
  (:derived (paused ?p - person)
    (exists (?t - test) (is ?t paused)))
  (:derived (aborted ?p - person)
    (exists (?t - test) (is ?t aborted)))

  ; the progress of the test
  (:derived (greeted ?p - person)
    (told greeting opening))
  (:derived (introduced ?i - item)
    (told introduction ?i))
  (:derived (described ?i - item)
    (and (introduced ?i)
         (forall (?o - option) (imply (offers ?i ?o) (told ?o ?i)))))
  (:derived (unanswered-once ?i - item)
    (and (was_unanswered_in first-question ?i) (not (answered ?i))))
  (:derived (unanswered-twice ?i - item)
    (and (was_unanswered_in second-question ?i) (not (answered ?i))))
  (:derived (done ?i - phase)
    (told explanation ?i))
  (:derived (done ?i - item)
    (or (answered ?i)
        (and (unanswered-twice ?i) (told moving-on ?i))))
  (:derived (thanked ?p - person)
    (exists (?i - phase) (told farewell ?i)))
  ; What the fallback delivers before the goodbye is not the report of a whole test.
  (:derived (reported ?p - person)
    (and (thanked ?p) (exists (?c - clinician) (was_delivered_to report ?c)))))
