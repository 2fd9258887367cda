;;; vocabulary
(define (domain words)
  (:requirements :typing :fluents :vocabulary)
  (:types
    frame symbol value agent resource - object
    text flag pose colour - value
    robot - frame
    boss - agent
    a b - symbol
    c - (either a b))
  (:constants
    speech - agent
    red - colour
    maybe - flag
    both - (either a b)
    x - a)
  (:predicates
    (alone ?x - a)
    (among ?x ?y ?z - a)
    (says ?x - a ?t - text)
    (holds ?x ?y - a)
    (twice ?x ?y - a))
  (:functions
    (total) - number
    (twice ?x ?y - a) - number
    (any ?x - (either a b)) - number
    (kinds ?x - a) - (either a b)
    (place ?x - a) - pose
    (rt ?x ?y - a) - pose
    (distance ?x - robot) - number
    (rt_x ?x ?y - robot) - number
    (priority ?x - a) - number)
  (:writes nobody twice)
  (:writes x twice)
  (:writes speech distance rt_x))
