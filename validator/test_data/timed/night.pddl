(define (problem night)
  (:domain shops)
  (:init (= (price) 5) (= (money) 9) (open) (at 17 (not (open))) (at 17 (sold-out)))
  (:goal (and (bought) (not (sold-out)))))
