(define (tower n)
  (make-sphere (xyz 0 0 n) (- n)))

(draw (tower 2))
