;;; vocabulary
(define (domain words)
  (:requirements :typing :equality :fluents :vocabulary)
  (:types
    frame symbol value agent resource - object
    pose - value
    body world - frame
    robot person - body
    clinician device test part utterance option state - symbol
    item phase - part)
  (:constants
    broken doubted paused - state
    speaker screen - device)
  (:predicates
    (is ?x - (either robot device test) ?s - state)
    (precedes ?a ?b - part)
    (offers ?i - item ?o - option)
    (is_with ?p - person ?r - robot)
    (was_said_in ?u - (either utterance option) ?p - part)
    (was_shown_in ?u - (either utterance option) ?p - part)
    (was_chosen_in ?o - option ?i - item)
    (attended ?c - clinician ?s - state))
  (:functions
    (rt ?parent ?child - frame) - pose
    (rt_x ?parent ?child - frame) - number
    (distance ?a ?b - frame) - number
    (label ?t - test ?p - part) - utterance
    (score ?i - item) - number))
;;; planning
(define (domain planning)
  (:requirements :typing :fluents)
  (:types person part - object item - part)
  (:predicates
    (present ?p - person)
    (near ?p - person)
    (introduced ?i - part)
    (described ?i - item)
    (answered ?i - item)
    (done ?i - part)
    (before ?i ?j - part)
    (next ?i ?j - part)
    (good ?i - item)
    (telling ?i - part)
    (alone)
    (needed ?p - person))
  (:functions (points ?i - item) (best ?i - item) (told-in ?i - item) (companions)))
;;; problem
(define (problem world)
  (:domain words)
  (:objects hall - world clarc - robot ann bob - person barthel - test clinician - clinician
    opening closing - phase feeding bathing stairs - item introduction - utterance one two - option)
  (:init
    (is_with ann clarc)
    (precedes opening feeding) (precedes feeding bathing) (precedes bathing stairs) (precedes stairs closing)
    (offers feeding one) (offers feeding two) (offers bathing one)
    (was_said_in introduction feeding) (was_shown_in introduction feeding)
    (was_said_in introduction bathing)
    (was_said_in one feeding) (was_shown_in one feeding)
    (was_chosen_in one bathing)
    (= (score feeding) 10) (= (score bathing) 5)
    (= (label barthel stairs) introduction)
    (= (rt_x hall clarc) 1) (= (rt_x hall ann) 3) (= (rt_x hall bob) 9))
  (:goal (and)))
;;; perception
(define (domain perception)
  (:requirements :adl :fluents :derived-predicates)
  (:import words planning)
  (:types toy - object)
  (:constants feeding - item)
  (:predicates (odd ?i - part) (even ?i - part))
  (:functions (price ?i - item) - number)
  (:derived (is_with ?p - person ?r - robot) (< (distance ?p ?r) 1))
  (:derived (odd ?i - part) (not (even ?i)))
  (:derived (even ?i - part) (not (odd ?i)))
  (:derived (introduced ?i - part) (next ?i ?i))
  (:derived (good ?i - item) (> (price ?i) 3))
  (:derived (present ?p - person) (exists (?t - toy) (and)))
  (:derived (described ?i - item)
    (and (or (answered ?i) (good ?i)) (or (answered ?i) (done ?i)) (or (good ?i) (done ?i))
         (or (answered ?i) (introduced ?i)) (or (good ?i) (introduced ?i)) (or (done ?i) (introduced ?i))
         (or (answered ?i) (telling ?i)) (or (good ?i) (telling ?i)) (or (done ?i) (telling ?i))
         (or (introduced ?i) (telling ?i))))
  (:derived (points ?i - item) (+ (score ?i) 1))
  (:derived (points ?i - item) (price ?i))
  (:derived (best ?i - item) (score feeding))
  (:derived (told-in ?i - item) (count (?o - item) (next ?i ?o)))
  (:derived (companions) (count (?t - toy) (and)))
  (:derived (companions) (count (?i - item) (odd ?i))))
