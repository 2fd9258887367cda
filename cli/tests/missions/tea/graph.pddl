(define (problem tea-graph)
  (:domain waiter)
  (:objects
    tea - test
    hello - part
    drink - item
    black green - option
    welcome - utterance
    which - question)
  (:init
    (offers drink black) (offers drink green)
    (= (score drink black) 1) (= (score drink green) 2))
  (:goal (and)))
