(define (problem menu-graph)
  (:domain waiter)
  (:objects
    tea - test
    hello - part
    drink - item
    black green - option
    welcome sorry - utterance
    which - question)
  (:init
    (offers drink black) (offers drink green)
    (= (silences_in drink) 0)
    (= (score drink black) 1) (= (score drink green) 2))
  (:goal (and)))
