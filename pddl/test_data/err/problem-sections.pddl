; with ../ok/typed-cars.pddl
(define (problem x extra)
  (:domain cars)
  (:init (parked t home))
  (:init)
  (:objekts a)
  (:goal)
  (:goal (parked t home)))
(and more)
