; a goal that is only preferred, and a predicate that is called preference
(define (domain d) (:requirements :preferences) (:predicates (p) (q)))

(define (problem e)
  (:domain d)
  (:init)
  (:goal (and (and (preference a (p)) (preference b (q))) (and)))
  (:metric maximize (- 10 (+ (is-violated a) (is-violated b) total-time))))
