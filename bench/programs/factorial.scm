; Big integers: made, divided, printed.
(define (factorial n) (if (= n 0) 1 (* n (factorial (- n 1)))))
(define (digits n) (string-length (number->string n)))
(define (digit-sum n) (let loop ((n n) (sum 0)) (if (= n 0) sum (loop (quotient n 1000000007) (+ sum (remainder n 1000003))))))
(write (do ((i 0 (+ i 1)) (sum 0 (+ sum (digits (factorial 1000)) (digit-sum (factorial 400))))) ((= i 150) sum)))
