(define (domain shops)
  (:requirements :durative-actions :timed-initial-literals :numeric-fluents :negative-preconditions)
  (:predicates (open) (bought) (sold-out))
  (:functions (price) (money))
  (:action buy
    :parameters ()
    :precondition (and (open) (>= (money) (price)))
    :effect (and (bought) (decrease (money) (price))))
  (:action sign :parameters () :precondition () :effect (not (sold-out)))
  (:durative-action browse
    :parameters ()
    :duration (= ?duration 3)
    :condition (over all (open))
    :effect (at end (bought))))
