; `:adl` announces most of it, and the costs need no fluents.
(define (domain hall)
  (:requirements :adl :action-costs)
  (:types lamp)
  (:predicates (lit ?x - lamp) (broken ?x - lamp))
  (:functions (power ?x - lamp) - number (total-cost) - number)
  (:action switch
    :parameters (?x ?y - lamp)
    :precondition (and (or (lit ?y) (broken ?x)) (not (broken ?x)) (= ?x ?y) (exists (?z - lamp) (lit ?z)))
    :effect (and (lit ?x) (forall (?z - lamp) (when (broken ?z) (not (lit ?z))))
      (increase (total-cost) (power ?x)))))
