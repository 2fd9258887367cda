; a domain whose names mean other things than those of rig; good but for the repeated predicate
(define (domain other)
  (:requirements :typing)
  (:types robot state)
  (:constants speaking - robot)
  (:predicates (is ?r - robot) (is ?r - robot))
  (:functions (score ?p)  (said ?r - robot) - number))
