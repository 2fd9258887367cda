; expect: exhausted
(define (problem two-places) (:domain gripper)
  (:objects a b b1 left)
  (:init (room a) (room b) (ball b1) (gripper left) (at-robby a) (free left) (at b1 a))
  (:goal (and (at b1 b) (at b1 a))))
