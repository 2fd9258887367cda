; The Barthel test as a planning problem: plain PDDL that every planner can read.
;
; How the robot speaks and shows is not modelled here: each action has a task of the same name in
; methods.hddl, and perception.pddl derives each predicate that an action changes.
(define (domain barthel)
  (:requirements :strips :typing :negative-preconditions)
  (:types
    person part - object
    item - part)
  (:predicates
    ; the person and the session; perception alone changes the predicates that no action changes
    (present ?p - person)             ; in view, in front of the robot
    (away ?p - person)                ; allow(never-true-predicate): out of view for so long that calling does not help
    (wants-help ?p - person)          ; allow(never-true-predicate)
    (impaired ?p - person)            ; allow(never-true-predicate): the robot cannot see, or cannot talk with, the person
    (calling ?p - person)             ; allow(never-true-predicate): somebody asked for help, and nobody has come
    (clinician-needed ?p - person)    ; allow(never-true-predicate): two items are without an answer
    (paused ?p - person)              ; allow(never-true-predicate)
    (aborted ?p - person)
    ; the progress of the test
    (next ?i ?j - part)
    (opens-with ?i - part)
    (closes-with ?i - part)
    (greeted ?p - person)
    (introduced ?i - item)
    (described ?i - item)
    (unanswered-once ?i - item)       ; allow(never-true-predicate)
    (unanswered-twice ?i - item)      ; allow(never-true-predicate)
    (done ?i - part)                  ; answered, or skipped after two silences
    (thanked ?p - person)
    (reported ?p - person))

  ; ---- the protocol ------------------------------------------------------------------------
  (:action greet
    :parameters (?p - person)
    :precondition (and (present ?p) (not (wants-help ?p)) (not (impaired ?p))
                       (not (clinician-needed ?p))
                       (not (paused ?p)) (not (aborted ?p)))
    :effect (greeted ?p))

  (:action explain
    :parameters (?p - person ?i ?j - part)
    :precondition (and (present ?p) (not (wants-help ?p)) (not (impaired ?p))
                       (not (clinician-needed ?p))
                       (not (paused ?p)) (not (aborted ?p))
                       (greeted ?p) (next ?i ?j) (opens-with ?i))
    :effect (done ?i))

  (:action introduce
    :parameters (?p - person ?i - part ?j - item)
    :precondition (and (present ?p) (not (wants-help ?p)) (not (impaired ?p))
                       (not (clinician-needed ?p))
                       (not (paused ?p)) (not (aborted ?p))
                       (next ?i ?j) (done ?i))
    :effect (introduced ?j))

  (:action describe
    :parameters (?p - person ?i - item)
    :precondition (and (present ?p) (not (wants-help ?p)) (not (impaired ?p))
                       (not (clinician-needed ?p))
                       (not (paused ?p)) (not (aborted ?p))
                       (introduced ?i))
    :effect (described ?i))

  (:action ask
    :parameters (?p - person ?i - item)
    :precondition (and (present ?p) (not (wants-help ?p)) (not (impaired ?p))
                       (not (clinician-needed ?p))
                       (not (paused ?p)) (not (aborted ?p))
                       (described ?i) (not (unanswered-once ?i)))
    :effect (done ?i))

  ; No answer in time: describe by voice again, show all options, ask again.
  (:action ask-again
    :parameters (?p - person ?i - item)
    :precondition (and (present ?p) (not (wants-help ?p)) (not (impaired ?p))
                       (not (clinician-needed ?p))
                       (not (paused ?p)) (not (aborted ?p))
                       (unanswered-once ?i) (not (unanswered-twice ?i)))
    :effect (done ?i))

  ; No answer again: the next item.
  (:action pass-over
    :parameters (?p - person ?i - item)
    :precondition (and (present ?p) (not (wants-help ?p)) (not (impaired ?p))
                       (not (clinician-needed ?p))
                       (not (paused ?p)) (not (aborted ?p))
                       (unanswered-twice ?i))
    :effect (done ?i))

  (:action thank
    :parameters (?p - person ?i ?j - part)
    :precondition (and (present ?p) (not (wants-help ?p)) (not (impaired ?p))
                       (not (clinician-needed ?p))
                       (not (paused ?p)) (not (aborted ?p))
                       (next ?i ?j) (done ?i) (closes-with ?j))
    :effect (thanked ?p))

  (:action report
    :parameters (?p - person)
    :precondition (and (thanked ?p) (not (aborted ?p)))
    :effect (reported ?p))

  ; ---- events that may occur at any moment -------------------------------------------------
  ; A request for help comes first: before the person is called back, fetched or asked about a silence,
  ; and even while the test is paused.
  (:action get-help
    :parameters (?p - person)
    :precondition (and (wants-help ?p) (not (aborted ?p)))
    :effect (not (wants-help ?p)))

  ; A robot that cannot see or talk waits until it can, or until the clinician has come.
  (:action have-repaired
    :parameters (?p - person)
    :precondition (and (impaired ?p) (not (wants-help ?p)) (not (aborted ?p)))
    :effect (not (impaired ?p)))

  (:action call-back
    :parameters (?p - person)
    :precondition (and (not (present ?p)) (not (away ?p)) (not (wants-help ?p)) (not (impaired ?p))
                       (not (paused ?p)) (not (aborted ?p)))
    :effect (present ?p))

  (:action have-fetched
    :parameters (?p - person)
    :precondition (and (not (present ?p)) (away ?p) (not (wants-help ?p)) (not (impaired ?p))
                       (not (paused ?p)) (not (aborted ?p)))
    :effect (and (present ?p) (not (away ?p))))

  (:action call-clinician
    :parameters (?p - person)
    :precondition (and (clinician-needed ?p) (not (wants-help ?p)) (not (impaired ?p))
                       (not (paused ?p)) (not (aborted ?p)))
    :effect (not (clinician-needed ?p)))

  ; Nobody who asked for help is left alone: at the end, the robot waits for whoever was called.
  (:action await-attendance
    :parameters (?p - person)
    :precondition (and (calling ?p) (reported ?p) (not (wants-help ?p)) (not (aborted ?p)))
    :effect (not (calling ?p)))

  (:action await-resumption
    :parameters (?p - person)
    :precondition (and (paused ?p) (not (wants-help ?p)) (not (aborted ?p)))
    :effect (not (paused ?p))))
