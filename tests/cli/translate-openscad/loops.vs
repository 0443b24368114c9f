; do, for, for-each, cond, case and a macro.
(define-syntax-rule (while-counting (i n) body) (for-each (lambda (i) body) (iota n)))
(define (kind i) (case (modulo i 3) [(0) 'low] [(1) 'middle] [else 'high]))
(define (height i)
  (let ([k (kind i)])
    (cond [(eq? k 'low) 10]
          [(eq? k 'middle) (+ 10 i)]
          [else (let* ([h 20] [h (+ h i)]) h)])))
(do ([i 0 (+ i 1)]) ((= i 5))
  (draw (make-cone (xyz (* i 40) 0 0) (xyz (* i 40) 0 (height i)) 12)))
(for ([x '(0 60)] [r '(8 12)])
  (draw (make-torus (xyz x 80 0) 25 r)))
(for* ([x (in-range 0 3)] [y 2] #:when (< x 2))
  (draw (make-box (xyz (* x 30) (+ 150 (* y 30)) 0) 20 20 (+ 5 x y))))
(while-counting (i 2) (draw (make-wedge (xyz (* i 40) 250 0) (xyz (+ 30 (* i 40)) 280 20))))
