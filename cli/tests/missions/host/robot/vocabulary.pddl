; The vocabulary of a waiter who hosts several guests, and whose goals others may hold and end.
(define (domain waiter)
  (:requirements :typing :fluents :vocabulary)
  (:types
    frame symbol value agent resource - object
    pose - value
    robot person - frame
    test part utterance state request document need goal - symbol
    item - part
    option question - utterance)
  (:constants
    pelea voice - agent
    loudspeaker - resource
    speaking held dropped glass - state
    help - request
    bill - document)
  (:predicates
    (is ?x - (either robot goal) ?s - state)
    (addresses ?p - part ?g - person)
    (holds_up ?p - person ?s - state)
    (is_with ?p - person ?r - robot)
    (offers ?i - item ?o - option)
    (was_said_in ?u - utterance ?p - part)
    (has_ordered ?p - person ?i - item)
    (was_chosen_in ?o - option ?i - item)
    (was_unanswered_in ?q - question ?i - item))
  (:functions
    (rt ?parent ?child - frame) - pose
    (rt_x ?parent ?child - frame) - number
    (label ?t - test ?p - part) - utterance
    (question ?t - test ?p - part) - question
    (score ?i - item ?o - option) - number)
  (:writes pelea label question)
  (:writes voice
    (is _ speaking) label question was_said_in has_ordered was_chosen_in was_unanswered_in))
