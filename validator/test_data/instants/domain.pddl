; A ball falls and bounces at instants that are no fractions of a second, and a curve touches a line at such an instant.
(define (domain instants)
  (:requirements :strips :typing :negative-preconditions :numeric-fluents :durative-actions
                 :duration-inequalities :time)
  (:predicates (airborne) (landed) (waving) (touched) (seen) (steady))
  (:functions (height) (speed) (t) (x))

  (:process falling
    :parameters ()
    :precondition (airborne)
    :effect (and (increase (speed) (* #t 10)) (decrease (height) (* #t (speed)))))

  (:event landing
    :parameters ()
    :precondition (and (airborne) (<= (height) 0) (> (speed) 0))
    :effect (and (landed) (assign (speed) (- (speed)))))

  ; x is 2 - (t^2 - 2)^2: 2 at the square root of 2, less at any other time.
  (:process wave
    :parameters ()
    :precondition (waving)
    :effect (and (increase (t) (* #t 1)) (increase (x) (* #t (* -4 (* (t) (- (* (t) (t)) 2)))))))

  (:event touch
    :parameters ()
    :precondition (and (waving) (steady) (>= (x) 2) (not (touched)))
    :effect (touched))

  (:action look
    :parameters ()
    :precondition (or (landed) (touched))
    :effect (seen))

  (:durative-action below
    :parameters ()
    :duration (>= ?duration 0)
    :condition (over all (< (x) 2))
    :effect (at end (seen)))

  (:durative-action not-above
    :parameters ()
    :duration (>= ?duration 0)
    :condition (over all (<= (x) 2))
    :effect (at end (seen)))

  (:durative-action over-ground
    :parameters ()
    :duration (>= ?duration 0)
    :condition (over all (>= (height) 0))
    :effect (at end (seen)))

  (:durative-action in-the-air
    :parameters ()
    :duration (>= ?duration 0)
    :condition (over all (> (height) 0))
    :effect (at end (seen))))
