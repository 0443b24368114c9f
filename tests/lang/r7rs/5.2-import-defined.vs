(define (double x) x)
(define-library (test defined) (export double) (import (scheme base)) (begin (define (double x) (* 2 x))))
(import (test defined))   ; expect error: import: double is defined here already; (except (test defined) double) omits the name, rename or prefix keep both names
