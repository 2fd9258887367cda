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

  (:action edge :parameters (?r - robot ?s - state) :precondition (is ?r ?s) :effect (and))
  (:action negated :parameters (?p - person ?r - robot) :precondition (not (is_with ?p ?r)) :effect (and))
  (:action either :parameters (?x - (either robot device)) :precondition (not (is ?x broken)) :effect (and))
  (:action exists :parameters (?i - part) :precondition (exists (?j - part) (precedes ?i ?j)) :effect (and))
  (:action no-successor :parameters (?i - part) :precondition (not (exists (?j - part) (precedes ?i ?j))) :effect (and))
  (:action forall :parameters (?i - part)
    :precondition (forall (?j - part) (imply (precedes ?j ?i) (exists (?t - test) (is_in ?t ?j)))) :effect (and))
  (:action or :parameters (?p - person) :precondition (or (= (seated ?p) true) (not (exists (?r - robot) (is_with ?p ?r)))) :effect (and))
  (:action same :parameters (?p ?q - person) :precondition (= ?p ?q) :effect (and))
  (:action differ :parameters (?p ?q - person) :precondition (not (= ?p ?q)) :effect (and))
  (:action fluent :parameters (?t - test ?i - part ?u - utterance) :precondition (= (label ?t ?i) ?u) :effect (and))
  (:action not-fluent :parameters (?u - utterance) :precondition (not (= (label barthel opening) ?u)) :effect (and))
  (:action undefined :parameters (?i - part) :precondition (not (exists (?u - utterance) (= (label barthel ?i) ?u))) :effect (and))
  (:action number :parameters (?i - item) :precondition (>= (score ?i) (* 2 5)) :effect (and))
  (:action numbers :parameters (?i - item) :precondition (> (score ?i) (worth ?i)) :effect (and))
  (:action flipped :parameters (?i - item) :precondition (< 6 (score ?i)) :effect (and))
  (:action near :parameters (?p - person ?r - robot) :precondition (<= (distance ?p ?r) 2.5) :effect (and))
  (:action far :parameters (?p - person ?r - robot) :precondition (not (<= (distance ?p ?r) 2.5)) :effect (and))
  (:action always :parameters () :precondition (and (< 1 2)) :effect (and))
  (:action never :parameters (?r - robot) :precondition (or) :effect (and)))
