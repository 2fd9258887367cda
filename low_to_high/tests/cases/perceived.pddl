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
  (:functions
    (points ?i - item)
    (told-in ?i - item)
    (companions)))
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
  (:constants introduction - utterance)
  (:predicates
    (unusable ?d - device)
    (told ?u - (either utterance option) ?i - part))
  (:derived (unusable ?d - device) (or (is ?d broken) (is ?d doubted)))
  (:derived (told ?u - (either utterance option) ?i - part)
    (and (or (was_said_in ?u ?i) (was_shown_in ?u ?i))
         (or (was_said_in ?u ?i) (unusable speaker))
         (or (was_shown_in ?u ?i) (unusable screen))))
  (:derived (present ?p - person) (exists (?r - robot) (is_with ?p ?r)))
  (:derived (near ?p - person) (exists (?r - robot) (< (distance ?p ?r) 3)))
  (:derived (introduced ?i - part) (told introduction ?i))
  (:derived (described ?i - item)
    (and (introduced ?i) (forall (?o - option) (imply (offers ?i ?o) (told ?o ?i)))))
  (:derived (answered ?i - item) (exists (?o - option) (was_chosen_in ?o ?i)))
  (:derived (done ?i - item) (answered ?i))
  (:derived (done ?i - phase) (and (introduced ?i) (not (exists (?j - part) (precedes ?i ?j)))))
  (:derived (before ?i ?j - part) (or (precedes ?i ?j) (exists (?k - part) (and (before ?i ?k) (before ?k ?j)))))
  (:derived (good ?i - item) (>= (score ?i) 10))
  (:derived (telling ?i - part) (exists (?t - test ?u - utterance) (= (label ?t ?i) ?u)))
  (:derived (alone) (not (exists (?p ?q - person) (and (not (= ?p ?q)) (present ?p) (present ?q)))))
  (:derived (needed ?p - person)
    (and (present ?p) (not (exists (?c - clinician) (attended ?c paused)))))
  (:derived (points ?i - item) (score ?i))
  (:derived (told-in ?i - item) (count (?o - option) (and (offers ?i ?o) (told ?o ?i))))
  (:derived (companions) (count (?p - person ?r - robot) (is_with ?p ?r))))
;;; ask (present ann)
;;; ask (present bob)
;;; ask (near bob)
;;; ask (introduced feeding)
;;; ask (introduced bathing)
;;; ask (introduced stairs)
;;; ask (described feeding)
;;; ask (done bathing)
;;; ask (done stairs)
;;; ask (done opening)
;;; ask (before opening bathing)
;;; ask (before bathing opening)
;;; ask (good bathing)
;;; ask (telling stairs)
;;; ask (telling feeding)
;;; ask (alone)
;;; ask (needed ann)
;;; ask (unusable speaker)
;;; ask (next feeding bathing)
;;; ask (present nobody)
