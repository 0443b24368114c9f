(define (column [foot point?] [height positive?] [radius positive? 0.5])
  (make-cylinder foot height radius))

(draw (column (xyz 0 0 0) 5))
(draw (column (xyz 2 0 0) -5))
