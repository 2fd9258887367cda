(define (domain hall)
  (:requirements :adl :derived-predicates)
  (:types place)
  (:predicates
    (road ?a ?b - place)
    (linked ?a ?b - place))
  (:derived (linked ?a ?b - place)
    (exists (?c - place)
      (and (road ?a ?c) (linked ?c ?b)))))
