; columns say nothing here, keys do
(define (domain d)
(:predicates (p ?x) (q ?x)
(r
?x))
(:predicates
(s
(t))
(:action a
:parameters (?x)
:precondition (and
(p ?x)
(q ?x)
:effect (not (p ?x)))
(:action b
:parameters (?x)
:effect (q ?x)))
