(define (tower n)
  (cond ((= n 0) '())
        ((= n 1) (list 1)
        (else (cons n (tower (- n 1))))))

(tower 3)
(display "x")
