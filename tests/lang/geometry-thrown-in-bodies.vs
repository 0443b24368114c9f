; expect no other warnings
; what a body makes before its last expression and nobody takes is told, once a place, where it was made
(define cube (make-box origin (xyz 1 1 1)))
(define (house)
  (make-box origin (xyz 4 4 3))           ; expect warning: this object is made and thrown away: a body gives only its last value, a loop none; unite them
  (make-cone (xyz 2 2 3) (xyz 2 2 5) 2))  ; expect warning: this object is made and thrown away: a body gives
(define (moved)
  (do-move cube ux)                       ; expect warning: this object is made and thrown away: do-move returns the moved object
  cube)
(let () (unite (house) (house)) (moved) (house) (volume cube)) ; expect warning: this object is made and thrown away: a body gives
(for ([i 3]) (make-sphere (xyz i 0 0) 1)) ; expect warning: this object is made and thrown away: a body gives only its last value, a loop none; unite them
(for-each (lambda (i) (make-sphere (xyz i 1 0) 1)) '(1 2)) ; expect warning: this object is made and thrown away
(do ([i 0 (+ i 1)]) ((= i 2)) (make-sphere (xyz i 2 0) 1)) ; expect warning: this object is made and thrown away
(let () (map (lambda (i) (make-sphere (xyz i 3 0) 1)) '(1 2)) 'done) ; expect warning: this object is made and thrown away
(when #t (make-sphere origin 2) 'done)    ; expect warning: this object is made and thrown away

; none of these is (no warning for them): what is drawn, measured alone, kept in a list and used, or nothing at all
(define kept '())
(define (keep! o) (set! kept (cons o kept)) o)
(define (all)
  (keep! (make-box (xyz 5 0 0) (xyz 6 1 1)))
  (keep! (make-box (xyz 7 0 0) (xyz 8 1 1)))
  (make-box origin (xyz 0 1 1))           ; expect warning: make-box: a box without width, depth or height: nothing is made
  (volume cube)
  (unite kept))
(define (twice o) (draw o) (draw (list (do-move o uy) (do-move o uz))) (map draw (list (do-move o ux))) o)
(draw (all))
(let () (twice cube) (for-each draw (list cube cube)) 'done) ; expect warning: this object is drawn already
(draw (subtract (house) (moved)))
