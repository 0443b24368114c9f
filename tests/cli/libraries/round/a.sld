(define-library (round a) (export a) (import (scheme base) (round b)) (begin (define a 1)))
