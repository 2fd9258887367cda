(define (domain hall)
  (:types lamp)
  (:predicates (lit ?x - lamp) (broken ?x - lamp) (dark) (ready))
  (:functions (power ?x - lamp) - number (next ?x - lamp) - lamp)
  (:derived (dark) (forall (?x - lamp) (not (lit ?x))))
  (:task brighten :parameters (?x - lamp))
  (:method by-hand
    :parameters (?x - lamp)
    :task (brighten ?x)
    :precondition (ready)
    :ordered-subtasks (and (switch ?x ?x)))
  (:action switch
    :parameters (?x ?y - lamp)
    :precondition (and (imply (lit ?y) (broken ?x)) (not (= ?x ?y)) (exists (?z - lamp) (lit ?z)))
    :effect (and (lit ?x) (when (dark) (ready))))
  (:durative-action wait
    :parameters (?x - lamp)
    :duration (<= ?duration (power ?x))
    :effect (at end (lit ?x))))
