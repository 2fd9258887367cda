; After an abort no question is asked: there is no plan, and the mission falls back.
(define (problem aborted)
  (:domain barthel)
  (:objects
    person - person
    opening closing - part
    stairs - item)
  (:init
    (opens-with opening) (closes-with closing)
    (next opening stairs)
    (next stairs closing)
    (present person)
    (aborted person))
  (:goal (and (reported person) (not (wants-help person))))) ; allow(unreachable-goal): that is the case
