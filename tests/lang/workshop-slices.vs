; contours and slices against closed forms; what is engraved; pins; what is refused
(define (close? a b share) (<= (abs (- a b)) (* share (abs b))))

; a cone's contours are circles of the right radius, lowest first, also of a surface and in other planes
(define cone (make-cone origin (xyz 0 0 10) 5))
(define (radii lists) (map (lambda (l) (map (lambda (c) (/ (round (* 100 (/ (curve-length c) 2pi))) 100)) l)) lists))
(displayln (radii (contours cone #:step 2)))               ; expect: ((5.0) (4.0) (3.0) (2.0) (1.0) ())
(displayln (radii (contours cone #:from 1 #:to 5 #:step 2))) ; expect: ((4.5) (3.5) (2.5))
(displayln (radii (contours (do-rotate cone 'y pi/2) #:from 2 #:to 8 #:step 3 #:plane 'yz))) ; expect: ((4.0) (2.5) (1.0))
(displayln (radii (contours (do-move cone (vxyz 0 0 100)) #:from 1 #:to 5 #:step 2 #:plane (make-plane (xyz 0 0 100) uz)))) ; expect: ((4.5) (3.5) (2.5))
(define skin (make-surface (lambda (u v) (cyl (* 5 (- 1 v)) (* 2pi u) (* 10 v))) #:nu 90 #:nv 7))
(displayln (radii (contours skin #:from 1 #:to 9 #:step 2)))   ; expect: ((4.5) (3.5) (2.5) (1.5) (0.5))
; two hills: two curves where they are apart, one below; a saddle's lines are open and end at the border
(define hills (make-surface (lambda (u v) (xyz (* 10 u) (* 10 v) (+ 1 (* 2 (sin (* 2pi u)) (sin (* 2pi u)) (sin (* pi v)))))) #:nu 60 #:nv 60))
(displayln (map length (contours hills #:from 1.5 #:to 2.5 #:step 0.5)))  ; expect: (2 2 2)
(define saddle (make-surface (lambda (u v) (xyz (- u 0.5) (- v 0.5) (* (- u 0.5) (- v 0.5)))) #:nu 20 #:nv 20))
(define saddle-lines (contours saddle #:from 1/16 #:to 1/8 #:step 1/16))
(displayln (map length saddle-lines))                      ; expect: (2 2)
(define (on-border? p) (or (near? (abs (cx p)) 1/2) (near? (abs (cy p)) 1/2)))
(displayln (every (lambda (c) (and (on-border? (curve-point c 0)) (on-border? (curve-point c (curve-length c))))) (append-map values saddle-lines)))
; expect: #t
; a plateau at the very height is the border of the higher part, once
(define steps (unite (make-3dface (xy 0 0) (xy 1 0) (xy 1 1) (xy 0 1)) (make-3dface (xy 1 0) (xyz 2 0 1) (xyz 2 1 1) (xy 1 1))))
(displayln (map (lambda (l) (map curve-length l)) (contours steps #:from 0 #:to 1 #:step 0.5))) ; expect: ((1.0) (1.0) ())
; without a step about ten heights, multiples of a round number
(displayln (map length (contours cone)))                   ; expect: (1 1 1 1 1 1 1 1 1 1 0)
(displayln (contours (empty-object) #:step 1))             ; expect: ()

; slices: their areas times the thickness are the volume; a sheet of each thickness, the last one cut short
(define (sum o t) (* t (apply + (map area (slices o t #:numbers #f)))))
(displayln (list (close? (sum (make-box origin (xyz 3 4 5)) 0.5) 60 1e-9) (close? (sum cone 0.25) (volume cone) 0.002)
                 (close? (sum (make-torus origin 10 4) 0.25) (volume (make-torus origin 10 4)) 0.002)
                 (length (slices (make-box origin (xyz 3 4 5)) 2)) (length (slices (make-box origin (xyz 3 4 5.0000000001)) 1))))
; expect: (#t #t #t 3 5)
(displayln (length (slices (do-rotate (make-box origin (xyz 3 4 5)) 'y pi/2) 1 #:plane 'yz)))  ; expect: 5

; layers: what is cut, and what is engraved of the slice above
(define (layers s)
  (let ((c (car (object-children s))))
    (if (eq? (object-kind c) 'unite) (map (lambda (l) (cons (car (object-arguments l)) (let ((c (car (object-children l)))) (if (eq? (object-kind c) 'unite) (map curve-length (object-children c)) (list (if (region? c) (area c) (curve-length c))))))) (object-children c))
        (list (list (car (object-arguments s)) (area s))))))
(define block (unite (make-box origin (xyz 4 4 3)) (make-box (xyz 1 0 3) (xyz 3 4 5)) (make-box (xyz 0 0 5) (xyz 9 4 6))))
(displayln (map layers (slices block 1 #:numbers #f)))
; expect: (((cut 16.0)) ((cut 16.0)) ((cut 16.0) (engrave 4.0 4.0)) ((cut 8.0)) ((cut 8.0)) ((cut 36.0)))
(displayln (map (lambda (s) (length (layers s))) (slices block 2)))  ; expect: (2 2 2)
(displayln (layers (car (slices (unite (make-box origin (xyz 6 6 1)) (make-box (xyz 2 2 1) (xyz 4 4 2))) 1 #:numbers #f)))) ; expect: ((cut 36.0) (engrave 8.0))
(displayln (map car (layers (car (slices (layer "oak" block) 3)))))  ; expect: (oak engrave)

; pins: two holes of the diameter join a slice to the next, above each other; nothing is lost but the holes
(define (holes s) (let ((r (car (object-children (car (object-children (car (object-children s))))))) ) (cdr (outline r))))
(define tower (make-box origin (xyz 20 12 6)))
(define pinned (slices tower 2 #:registration 'dowels #:diameter 1))
(displayln (map (lambda (s) (let ((h (holes s))) (list (length h) (every (lambda (c) (close? (area c) (* pi 1/4) 0.02)) h)))) pinned)) ; expect: ((2 #t) (2 #t) (2 #t))
(define (middles s) (map (lambda (c) (let ((p (centroid c))) (list (round (* 1e3 (cx p))) (round (* 1e3 (cy p)))))) (holes s)))
(displayln (equal? (middles (first pinned)) (middles (third pinned))))  ; expect: #t
(displayln (every (lambda (s) (every (lambda (c) (close? (area c) 4 1e-6)) (holes s))) (slices tower 2 #:registration 'tabs)))  ; expect: #t
(displayln (length (slices (make-box origin (xyz 20 1 6)) 2 #:registration 'dowels #:diameter 1))) ; expect warning: slices: 2 pairs of slices, the first 1 and 2, meet in too little for a pin
; expect: 3

(define-syntax fails (syntax-rules () ((_ e) (displayln (guard (c (#t (condition/report-string c))) e "no error")))))
(fails (contours cone #:step 0))                           ; expect: contours: step must be a positive number, got 0
(fails (contours cone #:from "low"))                       ; expect: contours: from must be a number, finite, got "low"
(fails (contours (make-circle origin 1) #:step 1))         ; expect: contours: o must be a solid or a surface, got (make-circle (xyz 0 0 0) 1)
(fails (contours cone #:step 1e-5))                        ; expect: contours: there are more than 10000 heights from 0.0 on by 0.00001
(fails (contours (make-3dface (xy 0 0) (xy 1 0) (xy 1 1) (xy 0 1)))) ; expect: contours: o is flat: #:step must be given
(fails (slices (make-circle origin 1) 1))                 ; expect: slices: o must be a solid, got (make-circle (xyz 0 0 0) 1)
(fails (slices cone -1))                                   ; expect: slices: thickness must be a positive number, got -1
(fails (slices cone 1e-6))                                 ; expect: slices: a thickness of 0.000001 makes 10000000 slices; 10000 are the most
(fails (slices cone 1 #:registration 'glue))               ; expect: slices: registration must be 'dowels, 'tabs or #f, got glue
