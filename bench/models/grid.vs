; The grid of the thesis' table 4.1, built as that program builds it: every cylinder is made again and moved, every row is moved.
; By the rule of counting it is 2n*n + n(n-1) + n + (n-1) commands: 7,853 for n = 51.
(define-parameter count 51)
(define (line)
  (unite (for/list ([i (in-range count)])
           (do-move (make-cylinder (xyz 0 0 0) 5 1) (vxyz (* 3 i) 0 0)))))
(draw (unite (for/list ([j (in-range count)])
               (do-move (line) (vxyz 0 (* 3 j) 0)))))
