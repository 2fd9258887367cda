(define (domain forms) (:requirements :typing :equality :negative-preconditions :existential-preconditions :fluents :durative-actions)
(:types car truck-with-a-long-name van - vehicle depot market-place road-crossing - place vehicle place other - object)
(:predicates (parked ?v - vehicle ?p - place) (road ?a ?b - place) (loaded ?v - vehicle) (clear ?p - place))
(:functions (distance-between ?from ?to - place) - number (weight-of-what-is-loaded ?v - vehicle) - number)
  (:ACTION short :parameters (?v - car) :effect (parked ?v home))
  (:action long :parameters (?v - vehicle ?from ?to - place ?a-further-place ?and-one-more - place ?b - place) :precondition (and (parked ?v ?from) (road ?from ?to) (not (loaded ?v))) :effect (and (not (parked ?v ?from)) (parked ?v ?to) (forall (?c - car) (when (parked ?c ?to) (not (parked ?c ?to))))))
  (:action broken
   :parameters
     (?v -vehicle
      ?p - place)
   :precondition (and
   (parked ?v ?p) (loaded ?v)
      )
   :effect (and (clear ?p) (not (loaded ?v))
     (forall (?c - car)
     (when (parked ?c ?p)
       (not (parked ?c ?p))))
     (clear ?p)))
  (:durative-action timed :parameters () :duration (= ?duration 5)
    :condition (over all (and (p)
       (q)))
    :effect (at end (increase (weight-of-what-is-loaded the-vehicle-that-has-been-loaded) (distance-between one-place another))))
)
(define (problem p) (:domain forms)
 (:objects a b c
    d - car

    home - place)
 (:init (parked a home) (parked b home)
 (parked c home)
 (= (distance-between home away) 3))
 (:goal
   (and (parked a home)
   (parked b home)))
 (:metric minimize (+ (distance-between a-place-with-a-long-name another-place-with-a-long-name) (total-time))))
