(define (domain d))
