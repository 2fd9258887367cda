(define (problem p) (:domain tour) (:objects here there - place)
  (:init (at here) (road here there)) (:goal (at there)))
