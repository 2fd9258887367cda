; Object fluents in all places: functions as arguments, values of values, undefined, two assignments at once.
(define (domain couriers)
  (:requirements :adl :object-fluents)
  (:types place thing - object van parcel - thing)
  (:constants nowhere - place)
  (:predicates (road ?a ?b - place) (swapped) (scattered) (torn))
  (:functions (at ?t - thing) - place (load ?v - van) - parcel (twin ?p - parcel) - parcel)

  (:action drive
    :parameters (?v - van ?to - place)
    :precondition (road (at ?v) ?to)
    :effect (assign (at ?v) ?to))
  (:action take
    :parameters (?v - van ?p - parcel)
    :precondition (and (= (at ?v) (at ?p)) (= (load ?v) undefined))
    :effect (and (assign (load ?v) ?p) (assign (at ?p) undefined)))
  (:action give
    :parameters (?v - van ?p - parcel ?where - place)
    :precondition (and (= (load ?v) ?p) (= (at ?v) ?where))
    :effect (and (assign (load ?v) undefined) (assign (at ?p) (at ?v))))
  (:action swap
    :parameters (?a ?b - parcel)
    :precondition (not (= (at ?a) undefined))
    :effect (and (assign (at ?a) (at ?b)) (assign (at ?b) (at ?a)) (swapped)))
  (:action scatter
    :parameters (?a ?b - parcel)
    :precondition (not (= (at ?a) undefined))
    :effect (and (assign (at ?a) nowhere) (assign (at ?b) undefined) (scattered)))
  (:action tear
    :parameters (?a ?b - parcel ?to - place)
    :effect (and (torn) (assign (at ?a) nowhere) (when (not (= (at ?b) undefined)) (assign (at ?b) ?to)))))
