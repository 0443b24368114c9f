(define-back-end text "txt"
  (lambda (objects port)
    (display "half" port)
    (car objects 5)))
(draw (make-sphere origin 1))
