(define (column p h)
  (make-cylinder p h 0.3)))

(define (row n)
  (column (xyz n 0 0) 3))
(row 5)
