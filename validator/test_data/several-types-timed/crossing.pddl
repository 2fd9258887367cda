(define (problem crossing) (:domain amphibious)
  (:objects duck - car duck - boat swan - boat home bank isle - place)
  (:init (at duck home) (road home bank) (river bank isle) (= (speed duck) 3) (= (speed swan) 2) (dry duck))
  (:goal (at duck isle)))
