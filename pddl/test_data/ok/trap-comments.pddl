;; before everything ( ( (
( ; one
define;two
(domain ; the name
hall);three ) ) )
;; ;
(:requirements;four
:strips ; ":typing
:typing)
(:types ; none (
a - object;b
b - ; the type
a)
(:predicates (p;?y
?x ; - b
- a))
(:action;name
go ; (
:parameters ; (?y
(?x ; - b
- ; a
a);
:precondition;(q)
(and ; ()
(p ?x))
:effect ; nothing
(not ; really
(p ?x))) ; the end
)
; between

(define (problem p);comment
(:domain hall;)
)
(:objects o - a;)
)
(:init (p o));)
(:goal ; )
(not (p o))))
; behind, without a line end
; no newline at the end