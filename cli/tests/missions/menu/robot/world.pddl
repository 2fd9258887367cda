(define (problem room)
  (:domain waiter)
  (:objects waiter - robot guest - person)
  (:init
    (is_with guest waiter)
    (= (rt_x waiter guest) 1))
  (:goal (and)))
