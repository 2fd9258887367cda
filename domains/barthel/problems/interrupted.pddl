; The same test, in the middle: two items left, the patient has gone far away, calls for help, and the first of
; the two items got no answer.
(define (problem interrupted)
  (:domain barthel)
  (:objects
    person - person
    opening closing - part
    mobility stairs - item)
  (:init
    (opens-with opening) (closes-with closing)
    (next opening mobility)
    (next mobility stairs)
    (next stairs closing)
    (greeted person)
    (done opening)
    (introduced mobility)
    (described mobility)
    (unanswered-once mobility)
    (away person)
    (wants-help person))
  (:goal (and (reported person) (not (wants-help person)))))
