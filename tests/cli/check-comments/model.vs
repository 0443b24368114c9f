(define (storey width angle) ; check: allow unused-parameter
  (make-box origin width width 3))
; check: allow unreferenced, unused
(define spare 3)
(define other 4)
(define number 5)
(define number "Hello World")
(display number)
(map (lambda (p letter) (storey p 1)) '(1 2) '(a b))
(draw (storey 1 2 3))
