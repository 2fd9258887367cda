;;; vocabulary
(define (domain words)
  (:requirements :typing :equality :fluents :vocabulary)
  (:types
    frame symbol value agent resource - object
    text flag pose - value
    body world - frame
    robot person - body
    device test part utterance state - symbol
    item phase - part)
  (:constants
    speech - agent
    loudspeaker - resource
    speaking broken - state
    true false - flag
    speaker - device)
  (:predicates
    (is ?x - (either robot device) ?s - state)
    (is_in ?t - test ?p - part)
    (precedes ?a ?b - part)
    (is_with ?p - person ?r - robot)
    (got ?p - person ?s - state))
  (:functions
    (rt ?parent ?child - frame) - pose
    (rt_x ?parent ?child - frame) - number
    (rt_yaw ?parent ?child - frame) - number
    (distance ?a ?b - frame) - number
    (label ?t - test ?p - part) - utterance
    (score ?i - item) - number
    (worth ?i - item) - number
    (seated ?p - person) - flag
    (heard ?p - person) - text)
  (:writes speech label (is _ speaking) (is speaker broken) rt))

;;; problem
(define (problem one)
  (:domain words)
  (:objects clarc ann-robot - robot hall - world)
  (:init
    (= (rt_x hall clarc) 1)
    (= (rt_x clarc ann-robot) 1)
    (= (rt_x ann-robot hall) 1))
  (:goal (and)))
