(define (problem lab-world)
  (:domain lab)
  (:objects
    world - world
    robot - robot
    person - person
    hello goodbye fire - sentence)
  (:init
    (is_with person robot)
    (is_not robot speaking))
  (:goal (and)))
