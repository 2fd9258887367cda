; The mission: a complete report, delivered after a goodbye, and no call for help left open.
(define (problem barthel-test)
  (:domain barthel)
  (:objects
    person - person
    opening closing - part
    feeding bathing grooming dressing bowels bladder toilet-use transfers mobility stairs - item)
  (:init
    (opens-with opening) (closes-with closing)
    (next opening feeding)
    (next feeding bathing)
    (next bathing grooming)
    (next grooming dressing)
    (next dressing bowels)
    (next bowels bladder)
    (next bladder toilet-use)
    (next toilet-use transfers)
    (next transfers mobility)
    (next mobility stairs)
    (next stairs closing))
  (:goal (and (reported person) (not (wants-help person)) (not (calling person)))))
