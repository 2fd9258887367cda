; as in 2000: a supertype of several lists, constants in parameters' types, untyped beside typed
(define (domain lift)
  (:requirements :adl :typing)
  (:types passenger - object
          going_up going_down vip going_nonstop never_alone - passenger
          conflict_A conflict_B - passenger
          floor - object)
  (:predicates
(origin ?person - passenger ?floor - floor)
;; entry of ?person is ?floor
(destin ?person - passenger ?floor - floor)
(no-access ?person - passenger ?floor - floor)
(above ?floor1 - floor  ?floor2 - floor)
(boarded ?person - passenger)
(not-boarded ?person - passenger)
(served ?person - passenger) (lift-at ?floor - floor) (shape ?o ?s) (busy ?o))
(:action stop
  :parameters (?f - floor)
  :precondition (and (lift-at ?f)
       (imply (exists (?p - conflict_A) (or (and (not (served ?p)) (origin ?p ?f)) (and (boarded ?p) (not (destin ?p ?f)))))
              (forall (?q - conflict_B) (and (or (destin ?q ?f) (not (boarded ?q))) (or (served ?q) (not (origin ?q ?f))))))
       (forall (?p - vip) (or (not (no-access ?p ?f)) (not (boarded ?p)))))
  :effect (and (forall (?p - passenger) (when (and (boarded ?p) (destin ?p ?f)) (and (not (boarded ?p)) (served ?p))))
               (forall (?p - passenger) (when (and (origin ?p ?f) (not (served ?p))) (boarded ?p)))))
(:action up :parameters (?f1 - floor ?f2 - floor) :precondition (and (lift-at ?f1) (above ?f1 ?f2))
  :effect (and (lift-at ?f2) (not (lift-at ?f1))))
(:action paint :parameters (?x ?new) :precondition (not (busy ?x))
  :effect (and (busy ?x) (shape ?x ?new)
               (forall (?old) (when (and (shape ?x ?old) (not (= ?old ?new))) (not (shape ?x ?old)))))))

(define (problem mixed-f2-p1)
   (:domain lift)
   (:objects p0 - vip p1 - conflict_A
             f0 f1 - floor)
(:init
(above f0 f1)
(origin p0 f1)
(destin p0 f0)




(lift-at f0)
)
(:goal (forall (?p - passenger) (served ?p)))
)
