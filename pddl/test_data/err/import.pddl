; with ../ok/vocabulary.pddl
; with ../ok/object-fluents.pddl
(define (domain d)
  (:requirements :typing)
  (:import rig carry nothing)
  (:types robot - person place)
  (:constants speaking - robot speech - agent)
  (:predicates (is ?r - robot) (lost ?a - person ?b - robot)))
