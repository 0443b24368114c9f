(define (tower n) (string-length (number->string (expt 7 n))))
(display (tower 1000000000))
