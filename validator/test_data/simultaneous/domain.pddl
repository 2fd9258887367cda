(define (domain swap)
  (:requirements :adl)
  (:predicates (in ?x ?place))
  (:action swap
    :parameters (?a ?b)
    :effect (forall (?x)
              (and
                (when (in ?x ?a) (and (not (in ?x ?a)) (in ?x ?b)))
                (when (in ?x ?b) (and (not (in ?x ?b)) (in ?x ?a)))))))
