(define (problem p) (:domain desk) (:objects ana bea - person hall room - place)
  (:init (= (seat ana) hall)) (:goal (met ana bea)))
