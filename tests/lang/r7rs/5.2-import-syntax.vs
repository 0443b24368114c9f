(import (only (scheme base) define))
(define (f x) x)
(let-values (((a b) (values 1 2))) a)   ; expect error: let-values is not defined; (import (scheme base)) brings it
