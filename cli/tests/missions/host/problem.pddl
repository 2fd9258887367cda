(define (problem one-evening)
  (:domain host)
  (:objects guest visitor - person drink cake - item)
  (:goal (ordered drink)))
