; expect: exhausted
(define (problem burnt) (:domain switches)
  (:objects a b - lamp)
  (:init (wired main a) (wired a b))
  (:goal (and (broken a) (lit b))))
