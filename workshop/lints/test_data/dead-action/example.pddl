(define (domain hall)
  (:requirements :typing)
  (:types door)
  (:predicates (open ?d - door) (unlocked ?d - door) (key))
  (:action unlock
    :parameters (?d - door)
    :precondition (and (key) (open ?d))
    :effect (unlocked ?d))
  (:action push
    :parameters (?d - door)
    :precondition (unlocked ?d)
    :effect (open ?d))
  (:action take
    :effect (key)))

(define (problem evening)
  (:domain hall)
  (:objects front back - door)
  (:init)
  (:goal (key)))
