(define (domain hall)
  (:requirements :typing :durative-actions :timed-initial-literals)
  (:types lamp)
  (:predicates (lit ?x - lamp) (dark) (open) (noisy))
  (:durative-action switch
    :parameters (?x - lamp)
    :duration (= ?duration 1)
    :condition (and (at start (dark)) (at start (open)) (at start (noisy)))
    :effect (at end (lit ?x))))

; Effects change who is lit, the rest only time does.
(define (problem evening)
  (:domain hall)
  (:objects left right - lamp)
  (:init (open) (at 9 (not (open))) (at 3 (open)) (at 12 (not (open))) (at 14 (open))
         (at 2 (not (dark))) (at 5 (dark)) (at 6 (not (lit left))) (at 7 (noisy)))
  (:goal (lit left)))
