; A small vocabulary for the tests of agents.
(define (domain lab)
  (:requirements :typing :equality :fluents :vocabulary)
  (:types
    frame symbol value agent resource - object
    pose - value
    world robot person - frame
    state sentence - symbol)
  (:constants
    director talker shouter watcher secretary polite heckler pedant clerk auditor driver host - agent
    mouth - resource
    speaking broken quiet absent - state)
  (:predicates
    (is ?r - robot ?s - state)
    (is_not ?r - robot ?s - state)
    (is_with ?p - person ?r - robot)
    (shall_say ?r - robot ?s - sentence)
    (shall_shout ?r - robot ?s - sentence)
    (shall_ask ?r - robot ?p - person)
    (waits_for ?r - robot ?p - person)
    (says ?r - robot ?s - sentence)
    (said ?r - robot ?s - sentence)
    (heard ?r - robot ?s - sentence)
    (missed ?r - robot ?p - person)
    (is_gone ?a - agent ?s - state))
  (:functions
    (rt ?a ?b - frame) - pose
    (distance ?a ?b - frame) - number
    (likes ?r - robot ?p - person) - sentence)
  (:writes director rt is_with shall_say shall_shout shall_ask (is _ broken) (is _ quiet))
  (:writes talker (is _ _) (is_not _ speaking) shall_say says said shall_ask waits_for heard missed)
  (:writes shouter (is _ speaking) (is_not _ speaking) shall_shout says said)
  (:writes watcher is_with rt)
  (:writes secretary said heard)
  (:writes polite waits_for shall_ask)
  (:writes heckler (is _ quiet))
  (:writes pedant heard shall_shout)
  (:writes clerk said heard)
  (:writes auditor said heard)
  (:writes driver waits_for shall_ask)
  (:writes host likes shall_ask))
