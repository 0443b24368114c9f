; Garbage: short-lived trees beside one that stays.
(define (make depth) (if (= depth 0) (vector #f #f) (vector (make (- depth 1)) (make (- depth 1)))))
(define (check tree) (if (vector-ref tree 0) (+ 1 (check (vector-ref tree 0)) (check (vector-ref tree 1))) 1))
(define (run n)
  (let ((long (make n)))
    (do ((depth 4 (+ depth 2))
         (sum 0 (+ sum
                   (let ((turns (expt 2 (- n depth))))
                     (do ((i 0 (+ i 1)) (sum 0 (+ sum (check (make depth))))) ((= i turns) sum))))))
        ((> depth n) (+ sum (check long))))))
(write (run 15))
