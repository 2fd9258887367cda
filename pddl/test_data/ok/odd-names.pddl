(define (domain a/b.c+d#e$f!g'h,i@j[k])
  (:types über-typ - object object x/y)
  (:predicates (p/1 ?x/y - x/y) (q.r ?a+b) (#s) ($t) (!u) (v') (w,x) (@y) ([z]) (größer ?x ?y) (a=b) (c<d) (%e) (&f) (*g) (h* ?x) (~i) (j|k) (a:b))
  (:action do/it! :parameters (?x/y - x/y ?ü) :precondition (and (p/1 ?x/y) (q.r ?ü) (#s) ($t) (!u) (v') (w,x) (@y) ([z]) (größer ?ü ?x/y) (a=b) (c<d) (%e) (&f) (*g) (h* ?ü) (~i) (j|k) (a:b)) :effect ([z])))
(define (problem p.1) (:domain a/b.c+d#e$f!g'h,i@j[k]) (:objects 1 2.5 n1/2 - x/y é o+ o, ) (:init (p/1 1) (p/1 2.5) (größer é o+)) (:goal (p/1 n1/2))) ; no end of line here
