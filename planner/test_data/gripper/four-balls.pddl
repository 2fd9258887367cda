; expect: cost 11
(define (problem four-balls) (:domain gripper)
  (:objects a b b1 b2 b3 b4 left right)
  (:init (room a) (room b) (ball b1) (ball b2) (ball b3) (ball b4) (gripper left) (gripper right)
         (at-robby a) (free left) (free right) (at b1 a) (at b2 a) (at b3 a) (at b4 a))
  (:goal (and (at b1 b) (at b2 b) (at b3 b) (at b4 b))))
