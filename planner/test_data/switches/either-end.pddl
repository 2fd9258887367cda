; expect: cost 4
(define (problem either-end) (:domain switches)
  (:objects a b c - lamp)
  (:init (wired main a) (wired a b) (wired b c))
  (:goal (or (and (lit c) (broken b)) (and (lit b) (not (lit a))))))
