(define (problem host-graph)
  (:domain waiter)
  (:objects
    host - test
    hello hello-visitor farewell - part
    drink cake - item
    black green plain - option
    welcome goodbye cheers - utterance
    which - question
    dessert - goal)
  (:init
    (addresses hello guest) (addresses hello-visitor visitor)
    (offers drink black) (offers drink green) (offers cake plain)
    (= (score drink black) 1) (= (score drink green) 2) (= (score cake plain) 4))
  (:goal (and)))
