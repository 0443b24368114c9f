(define-library (lib util)
  (export double)
  (import (scheme base))
  (begin (define (double x) (* 2 x))))
