; The vocabulary of a waiter who has a voice and a screen.
(define (domain waiter)
  (:requirements :typing :fluents :vocabulary)
  (:types
    frame symbol value agent resource - object
    pose - value
    robot person - frame
    test part utterance state request document need - symbol
    item - part
    option question - utterance)
  (:constants
    pelea voice panel - agent
    loudspeaker display - resource
    speaking showing - state
    help - request
    bill - document)
  (:predicates
    (is ?x - robot ?s - state)
    (is_with ?p - person ?r - robot)
    (offers ?i - item ?o - option)
    (was_said_in ?u - utterance ?p - part)
    (was_shown_in ?u - utterance ?p - part)
    (has_ordered ?p - person ?i - item)
    (was_chosen_in ?o - option ?i - item)
    (was_unanswered_in ?q - question ?i - item))
  (:functions
    (rt ?parent ?child - frame) - pose
    (rt_x ?parent ?child - frame) - number
    (label ?t - test ?p - part) - utterance
    (view ?t - test ?p - part) - utterance
    (question ?t - test ?p - part) - question
    (silences_in ?i - item) - number
    (score ?i - item ?o - option) - number)
  (:writes pelea label view question)
  (:writes panel (is _ showing) view was_shown_in)
  (:writes voice (is _ speaking) label question was_said_in has_ordered was_chosen_in was_unanswered_in silences_in))
