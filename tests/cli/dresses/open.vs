(define-primitive rod a)
(define r
  (make-rod 1))
(draw (subtract (make-box origin (xyz 1 1 1)) r))
