; as from 2006 on: a type declared twice, `object` among the types, action costs, names with signs, problems' own words
(define (domain stores)
(:requirements :typing :action-costs :equality :negative-preconditions :numeric-fluents :object-fluents)
(:types hoist surface place area - object
	container depot - place
        storearea transitarea - area
	area crate - surface
	object)
(:constants Black Color - surface letter-size_t - crate)
(:predicates (clear ?s - storearea) (in ?x - (either storearea crate) ?p - place) (Uninitialized) (on ?c - crate ?s - area)
             (sync#a_1 ?x) (object-goal ?o - object))
(:functions (total-cost) - number (cost-of ?f1 - place ?f2 - place) - number
            (slow ?x) (fast ?x) - number
            (holder ?c - crate) - (either hoist depot))
(:action go-1-2_a.b
 :parameters ( ?a ?b - place ?c - crate)
 :precondition (and (Uninitialized) (not (= ?a ?b)) (in ?c ?a)(not (in ?c ?b))
 )
 :effect (and (in ?c ?b) (not(in ?c ?a)) (increase (total-cost)(cost-of ?a ?b)))
)
(:action lift :parameters (?h - hoist ?c - crate ?s - storearea)
 :precondition (and (= (holder ?c) ?h) (clear ?s))
 :effect (and (assign (holder ?c) ?h) (increase (total-cost) 1)))
)
(define (problem stores-01)
 (:domain stores)
 (:objects
  d0 d1 - depot
  h - hoist
  c0 - crate
  o - object
  s0 - storearea
 )
 (:init
  (Uninitialized)
  (in c0 d0)
  (clear s0)
  (= (total-cost) 0)
  (= (cost-of d0 d1) 2001.5)
  (= (holder c0) h)
  (object-goal o)
 )
 (:goal (and (in c0 d1) (not (in c0 d0))))
 (:metric minimize (total-cost))
)
