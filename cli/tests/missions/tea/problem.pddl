(define (problem one-tea)
  (:domain tea)
  (:objects guest - person drink - item)
  (:goal (ordered drink)))
