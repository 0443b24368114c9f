; R7RS 5.2: a program that begins with imports sees what it imports, and nothing else
(define-library (test strict) (export double half) (import (scheme base)) (begin (define (double x) (* 2 x)) (define (half x) (/ x 2))))
(cond-expand ((library (scheme complex)) (import (scheme base))) (else (import (no such))))
(import (only (scheme write) display) (prefix (scheme char) c:))
(import (rename (except (test strict) half) (double twice)))
(define (later) (while 20))               ; a procedure may have the name of syntax that was not imported
(define (while n) (twice n))
(display (list (later) (c:char-upcase #\a) (if (vector? '#(1)) 'yes 'no)))
(newline)
; expect: (40 A yes)
(import (scheme base) (scheme inexact))   ; the same meaning from two libraries is no clash
(display (cond ((sqrt 16)) (else 0)))
(newline)
; expect: 4
(write-string "end\n")
; expect: end
(define (shout) (write "x"))   ; expect error: write is not defined; (import (scheme write)) brings it
(shout)
