(define (a x)
  (+ x 1)

(define (b x)
  (* x 2))

(define (c x)
  (let ((y x))
    (a y))

(define d 5))
(b 1
