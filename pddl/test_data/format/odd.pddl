; CRLF, byte order mark, ü in a comment
(DEFINE (DOMAIN Odd)
  (:Requirements :STRIPS :Typing)
  (:types 2d -a _t)
  (:predicates (3p ?1 -2d) (_q) (p-1 ?x - _t) (at ?x ?y) (start) (preference ?x) (increase ?x))
  (:ACTION 1-2 :PARAMETERS (?X - 2D) :precondition (preference ?x) :EFFECT (and (3P ?x) (_q) (increase ?x) (start))))
