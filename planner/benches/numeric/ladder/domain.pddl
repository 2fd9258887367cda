(define (domain ladder)
  (:requirements :typing :numeric-fluents)
  (:types rung)
  (:functions (height ?r - rung) (top))
  (:action up
    :parameters (?r - rung)
    :precondition (<= (+ (height ?r) 1) (top))
    :effect (increase (height ?r) 1))
  (:action down
    :parameters (?r - rung)
    :precondition (>= (height ?r) 1)
    :effect (decrease (height ?r) 1)))
