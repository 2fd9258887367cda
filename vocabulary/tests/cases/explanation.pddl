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

  (:action first-part :parameters (?p - person ?r - robot)
    :precondition (and (is_with ?p ?r) (is ?r broken) (not (is ?r speaking))) :effect (and))
  (:action got :parameters (?p - person) :precondition (got ?p speaking) :effect (and))
  (:action stands :parameters () :precondition (not (is clarc speaking)) :effect (and))
  (:action nobody :parameters () :precondition (not (exists (?p - person) (is_with ?p clarc))) :effect (and))
  (:action value :parameters (?t - test) :precondition (= (label ?t opening) goodbye) :effect (and))
  (:action number :parameters () :precondition (> (score feeding) 10) :effect (and))
  (:action undefined :parameters () :precondition (= (label barthel feeding) goodbye) :effect (and))
  (:action distance :parameters () :precondition (< (distance bob clarc) 2) :effect (and))
  (:action neither :parameters () :precondition (or (is clarc broken) (is speaker broken)) :effect (and))
  (:action together :parameters (?i - item) :precondition (and (= (score ?i) 5) (precedes feeding ?i) (precedes ?i bathing)) :effect (and))
  (:action all :parameters () :precondition (forall (?i ?j - part) (imply (precedes ?i ?j) (is_in barthel ?i))) :effect (and)))
