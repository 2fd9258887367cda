; What a `forall` chooses is no matter of the state.
(define (domain hall)
  (:requirements :typing :conditional-effects :numeric-fluents)
  (:types lamp)
  (:predicates (lit ?x - lamp) (good ?x - lamp) (near ?x ?y - lamp))
  (:functions (power ?x - lamp) (used))
  (:action switch
    :parameters (?x - lamp)
    :effect (and (when (good ?x) (lit ?x))
                 (when (> (power ?x) 5) (increase (used) 1))
                 (when (> (used) 5) (not (lit ?x)))
                 (forall (?y - lamp) (when (near ?x ?y) (lit ?y))))))
