; Records, procedures of several clauses, and folds.
(define-record-type storey (make-storey width height) storey? (height storey-height) (width storey-width set-width!))
(define storeys (map (lambda (i) (make-storey (- 10 i) (+ 2 (* 0.5 i)))) (iota 4)))
(define (total list) (for/fold ([sum 0]) ([s list]) (+ sum (storey-height s))))
(define block
  (case-lambda
    [(w h) (block w h 0)]
    [(w h z) (make-box (xyz 0 0 z) w w h)]))
(draw (block (storey-width (car storeys)) (total storeys)))
(define-values (last-x steps)
  (for/fold ([x 0] [n 1]) ([i 5] [step '(1 2 3)]) (values (+ x step i) (* n 2))))
(draw (make-capsule (xyz 20 0 0) (xyz (+ 20 last-x) 3 4) 2))
(draw (do-move (block 1 steps 3) (vxyz 0 20 0)))
(define (reach n) (for/fold ([far 0]) ([k (in-range n)]) (define next (+ far k)) (* next 1.5)))
(draw (make-capsule (xyz 0 -20 0) (xyz 0 -20 (reach 4)) 1.25))
