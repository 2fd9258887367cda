; Preferences, constraints, processes, events and effects across times use what they name.
(define (domain hall)
  (:requirements :typing :durative-actions :preferences :constraints :time :continuous-effects :conditional-effects)
  (:types lamp)
  (:predicates (lit ?x - lamp) (wanted ?x - lamp) (always-so) (burning) (hot) (was ?x - lamp) (known ?x - lamp) (unused))
  (:functions (heat))
  (:constraints (and (sometime (always-so)) (preference calm (always (not (burning))))))
  (:process warm
    :parameters ()
    :precondition (burning)
    :effect (increase (heat) (* #t 2)))
  (:event boil
    :parameters ()
    :precondition (and (not (hot)) (>= (heat) 100))
    :effect (hot))
  (:action light
    :parameters (?x - lamp)
    :precondition (preference asked (wanted ?x))
    :effect (and (lit ?x) (burning) (always-so)))
  (:durative-action look
    :parameters (?x - lamp)
    :duration (= ?duration 1)
    :condition (at start (lit ?x))
    :effect (when (at start (was ?x)) (at end (known ?x)))))
