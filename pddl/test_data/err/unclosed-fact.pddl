; two facts of a long state
(define (domain d)
  (:predicates (p ?x) (q ?x ?y)))
(define (problem e)
  (:domain d)
  (:objects a b c)
  (:init (p a)
         (q a b
         (p b)
         (q b c)
         (p c
         (q c a))
  (:goal (and (p a)
              (p b)))
