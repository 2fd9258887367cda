(define (domain carpets)
  (:requirements :strips)
  (:predicates (plain ?a) (woven ?a ?b ?c ?d ?e ?f))
  (:action turn :parameters (?a) :precondition (plain ?a) :effect (not (plain ?a)))
  ; 32^6 instances, a thousand million
  (:action weave :parameters (?a ?b ?c ?d ?e ?f)
    :precondition (and (plain ?a) (plain ?b) (plain ?c) (plain ?d) (plain ?e) (plain ?f))
    :effect (woven ?a ?b ?c ?d ?e ?f)))
