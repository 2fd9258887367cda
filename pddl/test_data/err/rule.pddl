(define (domain d)
  (:requirements :agent-rules)
  (:predicates (p ?x))
  (:constants a)
  (:durative-action x :parameters (?x)
    :condition (at abort (p ?x))
    :effect (and (at lost (p ?r)) (at end (p ?o)))
    :results ?o
    :skill say
    :claims (speaker ?x)
    :priority high))
