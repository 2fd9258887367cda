; as in 2014 to 2023: actions without parameters and preconditions, large disjunctions, numeric without a type, `(:functions (f) ;…`
(define (domain cube)
    (:requirements :adl :typing :numeric-fluents)
    (:types face colour counter)
    (:predicates
        (is ?x - face ?c - colour)
        (done)
    )
    (:functions
        (value ?c - counter);; - int  | the value shown
        (max_int)
        (rate ?c)
    )
    (:action L
        :effect (and (forall (?x - face ?c - colour) (when (is ?x ?c) (and (not (is ?x ?c)))))
                     (forall (?x) (and)) (done)))
    (:action U :parameters ( ) :precondition (or (done) (not (done))) :effect (and
    (when (done) (not (done)))
    ))
    ;; Increment the value in the given counter by one
    (:action increment
         :parameters (?c - counter)
         :precondition (and (<= (+ (value ?c) (rate ?c)) (max_int)) (>= (- (* 1.0 (value ?c)) (* -1 (rate ?c))) -1.5))
         :effect (and (increase (value ?c) (* 1 (rate ?c))))
    )
    (:action reset :parameters (?c - counter) :precondition (and (>= (value ?c) 1))
         :effect (and (assign (value ?c) 0.0))))
;; Enrico Scala (enrico.scala@unibs.it) and others
(define (problem instance_4)
  (:domain cube)
  (:objects
    c0 c1 - counter
  )
  (:init
    (= (max_int) 8)
	(= (value c0) 0)
	(= (value c1) 0.0)
    (= (rate c0) 1)
  )
  (:goal (and
(<= (+ (value c0) 1) (value c1))
  ))
)
