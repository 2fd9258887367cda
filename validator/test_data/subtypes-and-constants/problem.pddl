(define (problem p) (:domain zoo) (:objects tom - cat bo - dog c - cage)
  (:init (in rex c) (in tom c)) (:goal (and (fed tom) (fed bo))))
