(define (problem day)
  (:domain shops)
  (:init (= (price) 5) (= (money) 4) (at 9 (open)) (at 17 (not (open))) (at 15 (= (price) 3)))
  (:goal (bought)))
