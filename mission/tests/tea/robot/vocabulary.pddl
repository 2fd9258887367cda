; The vocabulary of a waiter: enough of one to order tea.
(define (domain waiter)
  (:requirements :typing :fluents :vocabulary)
  (:types
    frame symbol agent resource - object
    robot person - frame
    test part utterance state request document need - symbol
    item - part
    option question - utterance)
  (:constants
    pelea voice - agent
    loudspeaker - resource
    speaking - state
    help - request
    bill - document)
  (:predicates
    (is ?x - robot ?s - state)
    (is_in ?t - test ?p - part)
    (is_with ?p - person ?r - robot)
    (offers ?i - item ?o - option)
    (was_said_in ?u - utterance ?p - part)
    (was_chosen_in ?o - option ?i - item)
    (was_unanswered_in ?q - question ?i - item))
  (:functions
    (label ?t - test ?p - part) - utterance
    (score ?i - item ?o - option) - number)
  (:writes pelea is_in label)
  (:writes voice (is _ speaking) is_with label was_said_in was_chosen_in was_unanswered_in))
