; as in 2002: numeric and temporal, `total-time` with and without parentheses, durations that depend on the state
(define (domain depot)
(:requirements :typing :fluents :durative-actions :duration-inequalities)
(:types place locatable - object
	depot distributor - place
        truck hoist surface - locatable
        pallet crate - surface)
(:predicates (at ?x - locatable ?y - place) (on ?x - crate ?y - surface) (in ?x - crate ?y - truck)
             (clear ?x - surface) (charged ?t - truck))
(:functions (distance ?x - place ?y - place) (speed ?t - truck) (load_limit ?t - truck)
	(fuel ?t - truck) (recharges) (weight ?c - crate) (current_load ?t - truck))
(:durative-action Drive
:parameters (?x - truck ?y - place ?z - place)
:duration (= ?duration (/ (distance ?y ?z) (speed ?x)))
:condition (and (at start (at ?x ?y)) (at start (>= (fuel ?x) (* 2 (distance ?y ?z)))))
:effect (and (at start (not (at ?x ?y))) (at end (at ?x ?z)) (at end (decrease (fuel ?x) (* 2 (distance ?y ?z))))))
(:durative-action refuel
:parameters (?x - truck)
:duration (and (<= ?duration (/ (- 10 (fuel ?x)) (recharges))) (>= ?duration 0.01))
:condition (and (over all (charged ?x)))
:effect (at end (increase (fuel ?x) (* ?duration (recharges)))))
(:action Load
:parameters (?c - crate ?t - truck)
:precondition (and (<= (+ (current_load ?t) (weight ?c)) (load_limit ?t)) (clear ?c))
:effect (and (in ?c ?t) (increase (current_load ?t) (weight ?c)))))

(define (problem depotprob1818) (:domain depot)
(:objects
	depot0 - Depot
	distributor0 - Distributor
	truck0 - Truck
	crate0 - Crate
	)
(:init
	(at truck0 distributor0)
	(= (distance depot0 distributor0) 8)
	(= (speed truck0) 4)
	(= (fuel truck0) 9.5)
	(= (recharges) 0)
	(= (current_load truck0) 0)
)
(:goal (and
		(in crate0 truck0)
		(> (fuel truck0) 1)
	)
)
(:metric minimize (+ (* 4 total-time) (* 0.005 (fuel truck0))))
)
