;; head


;; of the file
(define (domain d) ; the name

  ; first
  (:predicates
	(p)  	; p
	(quite-long ?x)	; q

    (r) ;r

    ; nothing follows
    )

  (:action a
     ; what it needs
     :precondition ; trailing
       (and (p) ; one
         ; own line
            (r))

     :effect (not (p)   ; inside
        )
  ) ; end of a
  ; last
)
; behind
