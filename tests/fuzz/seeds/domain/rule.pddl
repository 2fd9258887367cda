(define (domain r) (:import vocabulary)
(:durative-action a :parameters (?x) :duration (<= ?duration 5) :condition (at start (p ?x))
:effect (and (at end (q ?x)) (at abort (not (p ?x)))) :skill (say ?x) :claims ((speaker :priority 2))))
