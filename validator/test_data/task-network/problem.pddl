(define (problem p) (:domain tidy) (:objects)
  (:htn :parameters () :ordered-subtasks (and (tidy)))
  (:init))
