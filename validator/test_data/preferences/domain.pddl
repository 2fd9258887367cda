(define (domain lamp)
  (:requirements :strips :preferences)
  (:predicates (lit) (warm))
  (:action light :parameters () :precondition () :effect (lit)))
