; Numbers in conditions and effects: sums, products, quotients, scaling, undefined values.
(define (domain numbers)
  (:requirements :adl :numeric-fluents)
  (:types jug)
  (:predicates (scale) (sealed) (weighed) (split))
  (:functions (level ?j - jug) (size ?j - jug) (taken) (price) (share) (steps) (spare))
  (:action fill
    :parameters (?j - jug)
    :precondition (< (level ?j) (size ?j))
    :effect (and (increase (taken) (- (size ?j) (level ?j))) (assign (level ?j) (size ?j)) (increase (steps) 1)))
  (:action empty
    :parameters (?j - jug)
    :precondition (> (level ?j) 0)
    :effect (and (assign (level ?j) 0) (increase (steps) 1)))
  (:action pour
    :parameters (?from ?to - jug)
    :precondition (and (not (= ?from ?to)) (> (level ?from) 0) (< (level ?to) (size ?to)))
    :effect (and
      (when (<= (+ (level ?from) (level ?to)) (size ?to))
        (and (assign (level ?from) 0) (increase (level ?to) (level ?from))))
      (when (> (+ (level ?from) (level ?to)) (size ?to))
        (and (decrease (level ?from) (- (size ?to) (level ?to))) (assign (level ?to) (size ?to))))
      (increase (steps) 1)))
  (:action dear
    :parameters ()
    :precondition (<= (price) 100)
    :effect (scale-up (price) 2))
  (:action cheap
    :parameters ()
    :precondition (>= (price) 1)
    :effect (scale-down (price) 2))
  (:action divide
    :parameters ()
    :effect (and (split) (assign (share) (/ (price) (spare)))))
  (:action weigh
    :parameters ()
    :precondition (and (scale) (forall (?j - jug) (>= (level ?j) 0.1)))
    :effect (and (weighed) (forall (?j - jug) (decrease (level ?j) 0.1))))
  (:action lend
    :parameters ()
    :precondition (< (spare) 4)
    :effect (increase (spare) 1))
  (:action clash
    :parameters (?a ?b - jug)
    :precondition (< (price) 0)
    :effect (and (sealed) (assign (level ?a) 0) (increase (level ?b) 1))))
