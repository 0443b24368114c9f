(define (climb n) (climb (+ n 1)))
(climb 0)
