(define (domain carry)
  (:requirements :fluents :typing)
  (:types thing place)
  (:functions (where ?t - thing) - place (held) - thing (count) - number)
  (:action carry
    :parameters (?t - thing ?from ?to - place)
    :precondition (and (= (where ?t) ?from) (not (= (held) ?t)) (= (count) 0))
    :effect (and (assign (where ?t) ?to) (assign (held) undefined) (scale-up (count) 2))))

(define (problem p)
  (:domain carry)
  (:objects box - thing a b - place)
  (:init (= (where box) a) (= (held) undefined) (= (count) 0))
  (:goal (= (where box) b)))
