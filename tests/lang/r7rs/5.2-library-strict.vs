(define-library (test body) (export f) (import (only (scheme base) define))
  (begin (define (f) (list 1))))
(import (scheme base) (test body))
(f)   ; expect error 2: list is not defined; (import (scheme base)) brings it
