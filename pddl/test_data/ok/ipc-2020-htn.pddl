; as in the HDDL domains of 2020: every key and its synonyms, ids of all kinds, empty keys, problem first words in any order
(define (domain transport)
  (:requirements :typing :hierarchy :method-preconditions :negative-preconditions :universal-preconditions :equality
                 :existential-preconditions :conditional-effects)
  (:types location locatable - object vehicle package - locatable capacity-number)
  (:constants c-0 c-1 - capacity-number)
  (:predicates (road ?l1 ?l2 - location) (at ?x - locatable ?v - location) (in ?x - package ?v - vehicle)
               (capacity ?v - vehicle ?s1 - capacity-number) (free ?v - vehicle))
  (:task deliver :parameters (?p - package ?l - location) :precondition () :effect ())
  (:task get-to :parameters (?v - vehicle ?l - location))
  (:task do_nothing :parameters ())
  (:method m-deliver
    :parameters (?p - package ?l1 ?l2 - location ?v - vehicle)
    :task (deliver ?p ?l2)
    :precondition (and (at ?p ?l1) (not (= ?l1 ?l2)) (forall (?x - package) (imply (in ?x ?v) (= ?x ?p)))
                       (exists (?c - capacity-number) (capacity ?v ?c)))
    :subtasks (and
     (task0 (get-to ?v ?l1))
     (t-1 (pick-up ?v ?l1 ?p c-1 c-0))
     (2 (get-to ?v ?l2))
     (drop (drop ?v ?l2 ?p c-0 c-1)))
    :ordering (and
      (< task0 t-1)
      (< t-1 2)
      (< 2 drop)
    )
    :constraints (and (not (= ?l1 ?l2))))
  (:method m-drive-to-ordering-0
    :parameters (?v - vehicle ?l1 - location ?l2 - location)
    :task (get-to ?v ?l2)
    :ordered-subtasks (and (get-to ?v ?l1) (drive ?v ?l1 ?l2)))
  (:method m-i-am-there
    :parameters (?v - vehicle ?l - location)
    :task (get-to ?v ?l)
    :precondition (at ?v ?l)
    :ordered-tasks (and (noop ?v ?l)))
  (:method m-empty :parameters () :task (do_nothing) :precondition () :tasks () :ordering () :constraints ())
  (:action drive :parameters (?v - vehicle ?l1 ?l2 - location) :precondition (and (at ?v ?l1) (road ?l1 ?l2))
    :effect (and (not (at ?v ?l1)) (at ?v ?l2)))
  (:action noop :parameters (?v - vehicle ?l2 - location) :precondition (at ?v ?l2) :effect ())
  (:action pick-up :parameters (?v - vehicle ?l - location ?p - package ?s1 ?s2 - capacity-number)
    :precondition (and (at ?v ?l) (at ?p ?l) (capacity ?v ?s1))
    :effect (and (not (at ?p ?l)) (in ?p ?v) (capacity ?v ?s2) (not (capacity ?v ?s1))))
  (:action drop :parameters (?v - vehicle ?l - location ?p - package ?s1 ?s2 - capacity-number)
    :precondition (and (at ?v ?l) (in ?p ?v)) :effect (and (not (in ?p ?v)) (at ?p ?l))))

(define
	(problem pfile01)
	(:domain  transport)
	(:objects package-0 - package city-0 city-1 - location truck-0 - vehicle)
	(:htn
		:parameters (?v - vehicle)
		:ordered-subtasks (and
		(task0 (deliver package-0 city-0))
		(task1 (get-to ?v city-1))
		))
	(:init
		(at package-0 city-1)
		(at truck-0 city-0)
		(capacity truck-0 c-1)
	)
	(:goal (and (at package-0 city-0)))
)
