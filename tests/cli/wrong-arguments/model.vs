(define (column foot height radius)
  (make-cylinder foot height radius))

(draw (column (xyz 0 0 0) 5))
