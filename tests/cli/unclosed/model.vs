(define (column foot height)
  (make-cylinder foot height 0.5)

(define (row n)
  (unite (map (lambda (i) (column (xy i 0) 5))
              (iota n))))

(draw (row 5))
