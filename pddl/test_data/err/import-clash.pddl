; with ../ok/vocabulary.pddl
; with ../ok/htn.pddl
; with import-clash-other.pddl
(define (domain d)
  (:import rig other))
