; with ../ok/adl.pddl
(defin (problem x))
