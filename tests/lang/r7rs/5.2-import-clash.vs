(define-library (test clash) (export car) (import (except (scheme base) car)) (begin (define (car x) x)))
(import (scheme base)
        (test clash))   ; expect error: import: car was imported already, with another meaning; (except (test clash) car) omits the name, rename or prefix keep both names
