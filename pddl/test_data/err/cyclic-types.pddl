(define (domain d)
  (:requirements :typing)
  (:types a - b b - c c - a
          d - d
          e - a f))
