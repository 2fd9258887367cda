; with ../ok/adl.pddl
(define (problem p)
  (:domain room)
  (:objects r1 - robot r1 - robot hall - room r1 - box)
  (:init (at r1 hal) (att r1 hall) (= (total-cost) many) (= (waight r1) 3) r1 (not (door)) (at r1 ?x))
  (:metric minimise (total-cost)))
