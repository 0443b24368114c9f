; What JavaScript has besides: variables that change, solids in lists, procedures that make solids, a long loop.
(define count 0)
(define (next!) (set! count (+ count 1)) count)
(define (each f l) (map f l))
(define balls (each (lambda (r) (make-sphere (xyz (* 40 (next!)) 0 0) r)) '(8 10 12)))
(draw (car balls) (do-move (list-ref balls 2) (vxyz 0 50 0)))
(define total (let loop ([i 0] [s 0]) (if (= i 100000) s (loop (+ i 1) (+ s 0.0001)))))
(for-each (lambda (o i) (when (odd? i) (draw (do-move o (vxyz 0 100 total))))) balls '(1 2 3))
(define side 4)
(draw (make-box (xyz 0 -140 0) side side side))
(define side (* side 5)) ; again
(draw (make-box (xyz 40 -140 0) side side side))
(define (tree n p)
  (cond [(= n 0) (make-sphere p 5)]
        [else (let ([q (+z p (* n 10))])
                (unite (make-cylinder p q (* n 2)) (tree (- n 1) (+x q n))))]))
(draw (tree 3 (xyz -60 0 0)))
(draw (make-box (xyz 0 -90 0) 10 (and (> total 9) total) (or #f (next!))))
