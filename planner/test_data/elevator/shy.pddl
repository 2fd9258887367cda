; expect: cost 8
(define (problem shy) (:domain elevator)
  (:objects f0 f1 f2 - floor ann bob - passenger queen - vip)
  (:init (lift-at f0) (from ann f0) (to ann f2) (from bob f1) (to bob f0) (from queen f1) (to queen f2) (shy ann))
  (:goal (forall (?p - passenger) (served ?p))))
