(define (domain durations)
  (:requirements :durative-actions :duration-inequalities :numeric-fluents :negative-preconditions)
  (:predicates (baked) (stirred) (rested) (warm) (cooled))
  (:functions (heat) (thickness))
  (:durative-action bake
    :parameters ()
    :duration (= ?duration 5)
    :condition ()
    :effect (at end (baked)))
  (:durative-action stir
    :parameters ()
    :duration (and (>= ?duration 2) (<= ?duration 4))
    :condition ()
    :effect (at end (stirred)))
  (:durative-action warm-up
    :parameters ()
    :duration (= ?duration (/ (thickness) (heat)))
    :condition ()
    :effect (and (at end (warm)) (at end (increase (heat) 1))))
  (:durative-action rest
    :parameters ()
    :duration (at end (>= ?duration (heat)))
    :condition ()
    :effect (and (at start (increase (heat) 2)) (at end (rested))))
  (:durative-action cool
    :parameters ()
    :duration ()
    :condition ()
    :effect (and (at end (cooled)) (at end (decrease (heat) ?duration)))))
