#!/usr/bin/env vs
;; Each form in the wrong place.


(define   (tower  n
  [width positive?]   #:material m) ; the parts


(let loop ([i 0]
[z 0]
)
  (cond [(= i n)
(list)]
    [else
        ;; upwards
      (cons (make-box (xyz 0 0 z) width width
          3)
    (loop (+ i 1)
  (+ z 3)))]))
  )
(define colours '((red 1)
   (green 2) ; two
     (blue 3)) ) #;(define unused
   (f 1))
#| a block
     stays |#
(for-each (lambda (x)
(draw x)) (tower 3 4 #:material stone))
(if (zero? 1)
"no
  indentation in texts"
  #\( )
(define-syntax-rule (swap! a b)
        (let ([t a])
            (set! a b)
(set! b t)))
(do ([i 0 (+ i 1)])
((= i 3)
  'done)
(display i))
(case x
[(1 2) 'few]
    [else 'many])
(define one 1)      ; comments that the author
(define twelve 12)  ; has aligned
(define three 3) ; one that is alone

(with-material plaster
(unite
(make-box origin 1 2 3)
(make-sphere origin 2)))
(define long (unite (make-box (xyz 0 0 0) (xyz 1 1 1)) (make-sphere (xyz 1 1 1) 2) (make-cylinder origin 1 (xyz 0 0 4))))
(define primes '(2 3 5 7 11 13 17 19 23 29 31 37 41 43 47 53 59 61 67 71 73 79 83 89 97 101 103 107 109 113))
(make-text origin 0.75 "a text of some length that stays whole" #:align 'center #:material stone #:height 12)
(define (pairs l) `(,@(map car l) . ,(cdr l)))
(define-record-type point
(make-point x y) point?
(x point-x) (y point-y))
(f ; why
a)
(a-call-that-is-alone
first second
   third
; the last
)
