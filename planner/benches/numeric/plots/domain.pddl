(define (domain plots)
  (:requirements :typing :numeric-fluents)
  (:types thing - object hand bed tap - thing)
  (:functions (maxx) (maxy) (x ?t - thing) (y ?t - thing) (carried) (poured ?b - bed) (loaded))
  (:action east
    :parameters (?h - hand)
    :precondition (<= (+ (x ?h) 1) (maxx))
    :effect (increase (x ?h) 1))
  (:action west
    :parameters (?h - hand)
    :precondition (>= (- (x ?h) 1) 1)
    :effect (decrease (x ?h) 1))
  (:action north
    :parameters (?h - hand)
    :precondition (<= (+ (y ?h) 1) (maxy))
    :effect (increase (y ?h) 1))
  (:action south
    :parameters (?h - hand)
    :precondition (>= (- (y ?h) 1) 1)
    :effect (decrease (y ?h) 1))
  (:action load
    :parameters (?h - hand ?t - tap)
    :precondition (and (= (x ?h) (x ?t)) (= (y ?h) (y ?t)) (<= (+ (carried) 1) 10))
    :effect (and (increase (carried) 1) (increase (loaded) 1)))
  (:action pour
    :parameters (?h - hand ?b - bed)
    :precondition (and (= (x ?h) (x ?b)) (= (y ?h) (y ?b)) (>= (carried) 1))
    :effect (and (decrease (carried) 1) (increase (poured ?b) 1))))
