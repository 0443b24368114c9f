; expect no other warnings
; what a body makes before its last expression and nobody takes is told, once a place, where it was made
(define cube (make-box origin (xyz 1 1 1)))
(define (house)
  (make-box origin (xyz 4 4 3))           ; expect warning: this object is made and not used: a body returns only its last value, a loop returns none; unite the objects, or (draw ...) each of them
  (make-cone (xyz 2 2 3) (xyz 2 2 5) 2))  ; expect warning: this object is made and not used: a body returns only its last value, a loop returns none; unite the objects, or (draw ...) each of them
(define (moved)
  (do-move cube ux)                       ; expect warning: this object is made and not used: do-move, do-rotate and similar procedures return a new object, and do not change their argument
  cube)
(let () (unite (house) (house)) (moved) (house) (volume cube)) ; expect warning: this object is made and not used: a body returns only its last value, a loop returns none; unite the objects, or (draw ...) each of them
(for ([i 3]) (make-sphere (xyz i 0 0) 1)) ; expect warning: this object is made and not used: a body returns only its last value, a loop returns none; unite the objects, or (draw ...) each of them
(for-each (lambda (i) (make-sphere (xyz i 1 0) 1)) '(1 2)) ; expect warning: this object is made and not used
(do ([i 0 (+ i 1)]) ((= i 2)) (make-sphere (xyz i 2 0) 1)) ; expect warning: this object is made and not used
(let () (map (lambda (i) (make-sphere (xyz i 3 0) 1)) '(1 2)) 'done) ; expect warning: this object is made and not used
(when #t (make-sphere origin 2) 'done)    ; expect warning: this object is made and not used

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
(let () (twice cube) (for-each draw (list cube cube)) 'done) ; expect warning: this object was drawn already, and is now in the drawing twice; remove this draw if a procedure has drawn the object
(draw (subtract (house) (moved)))
