(define (problem constant) (:domain amphibious)
  (:objects goose - boat home bank isle - place)
  (:init (at goose home) (road home bank) (river bank isle) (= (fuel goose) 1))
  (:goal (and (at goose isle) (ready))))
