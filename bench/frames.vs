; A space frame on four corner columns, of about the given number of members: milliseconds to make the net, to check the
; frame, and to solve it. `build/vs --quiet bench/frames.vs -D members=10000`
(import (visualscheme) (visualscheme analysis))
(define-parameter members 10000)
(define n (max 1 (exact (round (sqrt (/ members 8))))))
(define (timed name f)
  (let* ((start (current-milliseconds)) (value (f)))
    (printf "~a ~a ms~%" name (- (current-milliseconds) start))
    value))
(define net (timed "net" (lambda () (space-frame (lambda (u v) (xyz (* n 3 u) (* n 3 v) 0)) n n 2))))
(define corners (list 1 (+ n 1) (+ 1 (* n (+ n 1))) (square (+ n 1))))
(define f (timed "frame" (lambda () (frame (first net) (second net) #:supports corners #:sections (tube-section 0.1 0.006) #:loads '(weight)))))
(define r (timed "solve" (lambda () (frame-solve f))))
(printf "~a nodes, ~a members, ~a m~%" (length (first net)) (length (second net)) (apply min (map (lambda (i) (cz (displacement r i))) (iota (length (first net)) 1))))
