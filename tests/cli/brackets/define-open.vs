(define (column p h)
  (make-cylinder p h 0.3)

(define (row n)
  (map (lambda (i) (column (xyz i 0 0) 3))
       (range n)))

(row 5)
