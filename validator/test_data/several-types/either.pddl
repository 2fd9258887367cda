(define (problem either) (:domain amphibious)
  (:objects duck - (either car boat) home bank isle - place)
  (:init (at duck home) (road home bank) (river bank isle) (= (fuel duck) 1))
  (:goal (and (at duck isle) (ready))))
