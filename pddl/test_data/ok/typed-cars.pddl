; cars and places; cases in ../err refer to it
(define (domain cars)
  (:requirements :typing :fluents)
  (:types truck van - car place)
  (:constants home - place)
  (:predicates (parked ?c - car ?p - place))
  (:functions (driver ?c - car) - object (fuel ?c - car)))
