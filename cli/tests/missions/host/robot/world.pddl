(define (problem room)
  (:domain waiter)
  (:objects waiter - robot guest visitor - person)
  (:init
    (is_with guest waiter)
    (holds_up guest glass) (holds_up visitor glass)
    (= (rt_x waiter guest) 1))
  (:goal (and)))
