; The vocabulary: every token that CLARC's Deep State Representation can contain.
;
; A type is a type of nodes; below `frame`, the nodes have a pose. A binary predicate is the label of
; edges. A function is an attribute: a unary one of a node, a binary one of a pair of nodes. `:writes`
; lists the tokens that each agent may write; `_` and variables stand for any node. The graph accepts
; no token that is not declared here.
(define (domain clarc)
  (:requirements :typing :equality :fluents :vocabulary)
  (:types
    frame symbol value agent resource - object
    text pose - value
    world body device - frame
    robot person - body
    clinician room test part utterance answer state command request need urgency document - symbol
    item phase - part
    remark summons - utterance    ; a summons is also spoken to a person who is not in view
    option question - remark)
  (:constants
    pelea speech panel person-agent cgamed health - agent
    loudspeaker display turn - resource    ; `turn`: the person's turn to answer
    speaker screen microphone touch tracker console - device
    speaking showing paused aborted broken doubted unsteady patient - state
    pause resume abort - command
    help - request
    answer - answer
    report - document
    urgent - urgency
    unanswered assistance absence repair trouble - need)
  (:predicates
    ; the states of the robot, its devices and the test. A device is broken if it fails or does not
    ; answer, and doubted if it claims success where nothing was sensed, or rejects what it must do; both end
    ; when it is well again. It is unsteady for a minute after it broke: it may break again.
    (is ?x - (either robot device test person) ?s - state)
    (is_not ?r - robot ?s - state)
    (finish ?r - robot ?s - state)
    ; the present part of the test, and what was said and shown in each part
    (is_in ?t - test ?p - part)
    (precedes ?x ?y - option)
    (offers ?i - item ?o - option)
    (was_said_in ?u - utterance ?p - part)
    (was_shown_in ?u - utterance ?p - part)
    (was_told_in ?u - utterance ?p - part)         ; said or shown, and nothing of it was still to come
    (was_sensed_in ?u - utterance ?p - part)       ; said, and the microphone heard it: so it works, too
    (refuses ?d - device ?p - part)                ; rejected what it was to say or show, and works
    ; the people: a patient takes the test, others may be there
    (is_with ?p - person ?r - robot)
    (has_left ?p - person ?m - room)
    (asks ?p - person ?q - request)
    (can ?p - person ?a - answer)
    (waiting ?p - person ?a - answer)
    (got ?p - person ?a - answer)
    (was_chosen_in ?o - option ?i - item)
    (was_unanswered_in ?q - question ?i - item)
    (was_misheard_in ?q - question ?i - item)
    ; the clinician. PELEA wants, and may change its mind; CGAmed keeps what is needed until a clinician came.
    (is_wanted_for ?c - clinician ?n - need)
    (is_needed_for ?c - clinician ?n - need)
    (is_called_for ?c - clinician ?n - need)
    (is_overdue_for ?c - clinician ?n - need)      ; was called for it, and did not come in time
    (attended ?c - clinician ?n - need)
    (is_due_to ?d - document ?c - clinician)       ; PELEA wants it delivered
    (is_owed_to ?d - document ?c - clinician)      ; CGAmed delivers it, however long that takes
    (was_delivered_to ?d - document ?c - clinician))
  (:functions
    (rt ?parent ?child - frame) - pose
    (rt_x ?parent ?child - frame) - number      ; an RT edge in a world file: metres, radians
    (rt_y ?parent ?child - frame) - number
    (rt_z ?parent ?child - frame) - number
    (rt_yaw ?parent ?child - frame) - number
    (distance ?a ?b - frame) - number
    (label ?t - test ?p - part) - utterance     ; the sentence to say now
    (view ?t - test ?p - part) - utterance      ; the page to show now
    (question ?t - test ?p - part) - question   ; what the person is being asked
    (score ?i - item ?o - option) - number)

  (:writes pelea
    is_in label view question (can _ answer) (got _ answer)
    (is _ doubted) refuses (is_wanted_for _ _) (attended _ _) (is_due_to _ _)
    (was_delivered_to _ _))
  (:writes speech
    (is _ speaking) (is_not _ speaking) (finish _ speaking)
    (is speaker broken) (is speaker doubted) (is microphone broken) (is microphone doubted)
    (is tracker doubted)
    label was_said_in was_told_in was_sensed_in refuses
    can waiting got was_chosen_in was_unanswered_in was_misheard_in
    (asks _ help))
  (:writes panel
    (is _ showing) (is_not _ showing) (finish _ showing)
    (is screen broken) (is screen doubted) (is touch broken) (is tracker doubted)
    view was_shown_in was_told_in refuses
    can waiting got was_chosen_in was_unanswered_in
    (asks _ help))
  (:writes person-agent is_with has_left rt (is tracker broken))
  (:writes health (is _ broken) (is _ doubted) (is _ unsteady))
  (:writes cgamed
    (is _ paused) (is _ aborted) (is console doubted)
    is_wanted_for is_needed_for is_called_for is_overdue_for attended (asks _ help)
    is_due_to is_owed_to was_delivered_to))
