(define (chatter) (display "la la ") (chatter))
(chatter)
