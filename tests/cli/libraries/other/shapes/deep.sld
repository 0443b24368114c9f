(define-library (shapes deep)
  (export deep)
  (import (scheme base) (shapes flat))
  (begin (define (deep) (list 'deep (flat)))))
