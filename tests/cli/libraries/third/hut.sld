(define-library (hut)
  (export hut)
  (import (scheme base) (towers util))
  (begin (define (hut) (list 'hut (storey 2)))))
