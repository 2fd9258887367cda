; A small world: lamps that an agent lights when PELEA wants it, in a fixed order, and a bell at each lamp.
(define (domain lab)
  (:requirements :typing :equality :fluents :vocabulary)
  (:types agent resource symbol - object lamp state - symbol)
  (:constants pelea lighter - agent wanted lit broken ringing attended hushed - state)
  (:predicates (is ?l - lamp ?s - state) (stands_beside ?l ?m - lamp))
  (:writes pelea (is _ wanted) (is _ ringing) (is _ hushed))
  (:writes lighter (is _ lit) (is _ broken) (is _ wanted) (is _ attended) stands_beside))
