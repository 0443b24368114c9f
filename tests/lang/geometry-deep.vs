; Solids that stand many times in one expression, at any depth, are one solid for the mesher
(define small (make-box (xyz 0 0 0) (xyz 1 1 1)))
(define big (make-box (xyz -1 -1 -1) (xyz 2 2 2)))
(define (alternate n)
  (let loop ([i 0] [o small])
    (if (= i n) o (loop (+ i 1) (subtract big o)))))
(displayln (volume (alternate 20000)))   ; expect: 1.0
(displayln (volume (alternate 20001)))   ; expect: 26.0
(define (pile n)
  (let loop ([i 0] [o small])
    (if (= i n) o (loop (+ i 1) (unite o (make-box (xyz 0 0 0) (xyz 1 1 2)))))))
(displayln (volume (pile 20000)))        ; expect: 2.0
; the same solid added here and taken off there
(define half (make-box (xyz 0 0 0) (xyz 0.5 1 1)))
(displayln (volume (unite (subtract small half) (intersect half (subtract big half)) half)))  ; expect: 1.0
(displayln (volume (subtract (unite small half) half)))                                       ; expect: 0.5
