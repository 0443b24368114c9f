(define-library (other name) (export x) (import (scheme base)) (begin (define x 1)))
