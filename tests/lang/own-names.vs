; A program that defines a name of the language keeps its own: a later version with more names breaks nothing.
(define (make-sphere n) (* 2 n))
(define (window-of-a-later-version) 5)
(display (make-sphere 4)) (newline)
; expect: 8
(display (+ (window-of-a-later-version) (car (map make-sphere '(1)))))
(newline)
; expect: 7
