(define (problem p) (:domain lamps)
  (:objects hall bed - lamp left right - switch)
  (:init (wired left hall) (wired left bed) (wired right bed) )
  (:goal (checked)))
