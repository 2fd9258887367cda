; The types of one pair exclude each other, another pair is kept apart by a fact and its negation, a third by a road.
(define (domain hall)
  (:requirements :typing :negative-preconditions :equality)
  (:types cart place - object inside outside - place)
  (:predicates (at ?c - cart ?p - place) (busy ?p - place) (road ?p ?q - place))
  (:action move
    :parameters (?c - cart ?from ?to - place)
    :precondition (at ?c ?from)
    :effect (and (not (at ?c ?from)) (at ?c ?to)))
  (:action leave
    :parameters (?c - cart ?from - inside ?to - outside)
    :precondition (at ?c ?from)
    :effect (and (not (at ?c ?from)) (at ?c ?to)))
  (:action far
    :parameters (?c - cart ?from ?to - place)
    :precondition (and (at ?c ?from) (not (= ?to ?from)))
    :effect (and (not (at ?c ?from)) (at ?c ?to)))
  (:action drive
    :parameters (?c - cart ?from ?to - place)
    :precondition (and (at ?c ?from) (road ?from ?to))
    :effect (and (not (at ?c ?from)) (at ?c ?to)))
  (:action hand
    :parameters (?from ?to - place)
    :precondition (and (busy ?from) (not (busy ?to)))
    :effect (and (not (busy ?from)) (busy ?to))))
