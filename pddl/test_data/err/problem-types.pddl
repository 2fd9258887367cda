; with ../ok/typed-cars.pddl
(define (problem p)
  (:domain cars)
  (:objects t1 - truck there - place anything)
  (:init (parked t1 t1) (parked home there) (parked anything there) (= (fuel home) 3) (= (fuel t1) t1))
  (:goal (and (parked t1 there) (exists (?p - place) (parked ?p ?p)) (= (fuel t1) full))))
