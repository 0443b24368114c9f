; A rack of shelves & <tags>.
;
; It is described by its own comments.
(load "parts.vs")
(define-parameter shelves 4 #:min 1 #:max 9)

; One shelf at height z: a board "with" quotes.
; It has two lines.
(define (shelf z [width any? 2])
  (let ([depth 0.4])
    (make-box (xyz 0 0 z) (xyz width depth (+ z thickness)))))

(define (rack n #:gap [gap any? 0.5])
  "Stands on the ground."
  (unite (map (lambda (i) (shelf (* i gap))) (iota n))
         (do-move (make-cylinder (xyz 0 0 0) (* n gap) thickness) (vxyz 0 0.2 0))
         (do-move (make-cylinder (xyz 0 0 0) (* n gap) thickness) (vxyz 0 0.2 0))))

(draw (rack shelves))
