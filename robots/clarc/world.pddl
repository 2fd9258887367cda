; The pose of CLARC before a person is seen.
; Each pose is that of the second frame in the first, in metres and radians.
(define (problem consulting-room)
  (:domain clarc)
  (:objects
    world - world
    robot - robot
    person visitor - person
    room - room
    clinician - clinician)
  (:init
    (is person patient)
    (is_not robot speaking)
    (is_not robot showing)
    (= (rt_x world robot) 0)
    (= (rt_x robot speaker) 0.1) (= (rt_z robot speaker) 1.1)
    (= (rt_x robot microphone) 0.2) (= (rt_z robot microphone) 1.4)
    (= (rt_x robot screen) 0.2) (= (rt_z robot screen) 1.2)
    (= (rt_x robot touch) 0.2) (= (rt_z robot touch) 1.2)
    (= (rt_x robot tracker) 0.1) (= (rt_z robot tracker) 1.5)
    (= (rt_x robot console) 0))
  (:goal (and)))
