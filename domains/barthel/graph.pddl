; The Barthel index as nodes and edges: its parts, the options of each item in order, and the score
; of each option (Mahoney & Barthel, "Functional evaluation: the Barthel index", 1965).
; The best option comes first; the scores add up to at most 100. The order in which the items are asked is that of
; problem.pddl (`next`).
(define (problem barthel-graph)
  (:domain clarc)
  (:objects
    barthel - test
    opening closing - phase
    feeding bathing grooming dressing bowels bladder toilet-use transfers mobility stairs - item
    option-1 option-2 option-3 option-4 - option
    greeting explanation introduction all-options moving-on farewell please-touch - remark
    first-question second-question - question
    sit-down stay-calm help-is-coming no-connection - summons)
  (:init
    (is_in barthel opening)
    (precedes option-1 option-2) (precedes option-2 option-3) (precedes option-3 option-4)
    (offers feeding option-1) (offers feeding option-2) (offers feeding option-3)
    (= (score feeding option-1) 10) (= (score feeding option-2) 5) (= (score feeding option-3) 0)
    (offers bathing option-1) (offers bathing option-2)
    (= (score bathing option-1) 5) (= (score bathing option-2) 0)
    (offers grooming option-1) (offers grooming option-2)
    (= (score grooming option-1) 5) (= (score grooming option-2) 0)
    (offers dressing option-1) (offers dressing option-2) (offers dressing option-3)
    (= (score dressing option-1) 10) (= (score dressing option-2) 5) (= (score dressing option-3) 0)
    (offers bowels option-1) (offers bowels option-2) (offers bowels option-3)
    (= (score bowels option-1) 10) (= (score bowels option-2) 5) (= (score bowels option-3) 0)
    (offers bladder option-1) (offers bladder option-2) (offers bladder option-3)
    (= (score bladder option-1) 10) (= (score bladder option-2) 5) (= (score bladder option-3) 0)
    (offers toilet-use option-1) (offers toilet-use option-2) (offers toilet-use option-3)
    (= (score toilet-use option-1) 10) (= (score toilet-use option-2) 5)
    (= (score toilet-use option-3) 0)
    (offers transfers option-1) (offers transfers option-2)
    (offers transfers option-3) (offers transfers option-4)
    (= (score transfers option-1) 15) (= (score transfers option-2) 10)
    (= (score transfers option-3) 5) (= (score transfers option-4) 0)
    (offers mobility option-1) (offers mobility option-2)
    (offers mobility option-3) (offers mobility option-4)
    (= (score mobility option-1) 15) (= (score mobility option-2) 10)
    (= (score mobility option-3) 5) (= (score mobility option-4) 0)
    (offers stairs option-1) (offers stairs option-2) (offers stairs option-3)
    (= (score stairs option-1) 10) (= (score stairs option-2) 5) (= (score stairs option-3) 0))
  (:goal (and)))
