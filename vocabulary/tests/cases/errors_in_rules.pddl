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
  (:constants barthel - test opening - phase feeding bathing stairs - item greeting goodbye - utterance
    clarc - robot ann bob - person hall - world)

  (:predicates (told ?u - utterance) (asked ?u - utterance ?p - part))
  (:functions (price ?u - utterance) - number)
  (:action not-a-token :parameters (?u - utterance) :precondition (told ?u) :effect (asked ?u opening))
  (:action not-an-attribute :parameters (?u - utterance) :precondition (< (price ?u) 3) :effect (increase (price ?u) 1))
  (:action value-variable :parameters () :precondition (exists (?x - text) (= (heard ann) ?x)) :effect (and))
  (:action arithmetic :parameters () :precondition (< (+ (score feeding) 1) 3) :effect (and))
  (:action pose :parameters () :precondition (exists (?at - pose) (= (rt hall ann) ?at)) :effect (and))
  (:action pose-part :parameters () :precondition (< (rt_x hall ann) 3) :effect (assign (rt_x hall ann) 3))
  (:action computed :parameters () :precondition (and) :effect (assign (distance ann bob) 3))
  (:action nothing :parameters () :precondition (< (/ 1 0) 3) :effect (and)))
