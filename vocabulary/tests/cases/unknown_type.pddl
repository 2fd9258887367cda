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
(define (problem world)
  (:domain words)
  (:objects hall - world clarc - robot ann bob - person barthel - test
    opening - phase feeding bathing stairs - item greeting goodbye - utterance)
  (:init
    (is clarc speaking) (is_in barthel opening) (is_with ann clarc)
    (precedes opening feeding) (precedes feeding bathing) (precedes bathing stairs)
    (= (label barthel opening) greeting)
    (= (score feeding) 10) (= (worth feeding) 5) (= (score bathing) 5)
    (= (seated ann) true)
    (= (rt_x hall clarc) 1) (= (rt_x hall ann) 3) (= (rt_yaw hall ann) 3.14) (= (rt_x hall bob) 9))
  (:goal (and)))
;;; rules
(define (domain rules)
  (:requirements :typing :adl :fluents :quantified-preconditions :disjunctive-preconditions)
  (:import words)

  (:types toy - object)
  (:action play :parameters (?t - toy) :precondition (and) :effect (and)))
