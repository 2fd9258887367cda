; expect: cost 0
(define (problem already) (:domain gripper)
  (:objects a b b1 left)
  (:init (room a) (room b) (ball b1) (gripper left) (at-robby a) (free left) (at b1 a))
  (:goal (and (at b1 a) (free left))))
