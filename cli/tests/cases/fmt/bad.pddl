(define (domain hall)  ; a hall
(:predicates(lit ?x-lamp))
   (:action switch
:parameters (?x - lamp) :effect (lit
 ?x)))