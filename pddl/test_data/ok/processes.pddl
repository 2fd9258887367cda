; PDDL+; rates in every form
(define (domain tank)
  (:requirements :typing :fluents :time :negative-preconditions)
  (:types tap)
  (:predicates (open ?t - tap) (full))
  (:functions (level) (flow ?t - tap) (leak))
  (:process fill
    :parameters (?t - tap)
    :precondition (and (open ?t) (forall (?u - tap) (or (= ?u ?t) (not (open ?u)))))
    :effect (and (increase (level) (* #t (flow ?t))) (decrease (leak) (* (flow ?t) #t))))
  (:process drip
    :effect (forall (?t - tap) (and (decrease (level) #t) (increase (flow ?t) (* 2 (* #t (leak)) 0.5)))))
  (:process more :parameters () :precondition ()
    :effect (and (increase (level) (/ (* #t 3) 2)) (increase (level) (+ #t (* #t (leak)))) (increase (level) (- #t))
                 (increase (level) (* #t (* (leak) (leak)))) (decrease (level) (* #t 1))))
  (:event overflow
    :parameters ()
    :precondition (>= (level) 10)
    :effect (and (full) (assign (level) 10) (forall (?t - tap) (when (open ?t) (not (open ?t))))))
  (:event nothing :parameters (?t - tap) :precondition (open ?t) :effect ())
  (:action turn :parameters (?t - tap) :effect (open ?t)))
