; Facets of solids: fewer, finer, curved; text along curves and on surfaces.
(define-syntax fails
  (syntax-rules ()
    ((_ e) (guard (c ((error-object? c) (displayln (condition/report-string c)))) e (displayln "no error")))))
(define (corners o) (first (object-arguments o)))
(define (facets o) (length (second (object-arguments o))))
(define brick (make-box origin (xyz 4 3 2)))

; ---- finer, and back ----
(define fine (refine brick 0.5))
(displayln (list (volume fine) (area fine) (> (facets fine) 400)))                               ; expect: (24.0 52.0 #t)
(define (longest o)
  (let ((p (list->vector (corners o))))
    (apply max (append-map (lambda (f) (map (lambda (a b) (distance (vector-ref p (- a 1)) (vector-ref p (- b 1)))) f (append (cdr f) (list (car f))))) (second (object-arguments o))))))
(displayln (<= (longest fine) 0.5))                                                              ; expect: #t
(displayln (let ((back (simplify fine 1e-6))) (list (facets back) (volume back))))               ; expect: (12 24.0)
; ---- fewer: near the old surface ----
(define ball (make-sphere origin 1 #:segments 48))
(define (kept? tolerance)
  (let ((o (simplify ball tolerance)))
    (and (< (facets o) 1200) (every (lambda (p) (near? (distance p origin) 1 1e-6)) (corners o)) (< (- (volume ball) (volume o)) (* 2 tolerance (area ball))))))
(displayln (map kept? '(0.02 0.05 0.2)))                                                         ; expect: (#t #t #t)
(random-seed! 2)
(define (random-solid i) (subtract (make-box origin (xyz 4 4 4)) (make-sphere (xyz (random 4.0) (random 4.0) (random 4.0)) 1.5) (make-cylinder (xyz 2 2 -1) 6 0.5)))
(displayln (every (lambda (i) (let* ((o (random-solid i)) (s (simplify o 0.05))) (< (abs (- (volume s) (volume o))) (* 0.1 (area o))))) (iota 8))) ; expect: #t
(displayln (simplify (empty-object) 1))                                                          ; expect: (empty-object)
(displayln (map object-layer (object-children (refine (unite (layer "a" brick) (layer "b" (do-move brick (vxyz 9 0 0)))) 1)))) ; expect: (a b)
; ---- curved: nearer to the round solid than the facets; sharp edges stay ----
(define (nearer? round-volume coarse) (let ((s (do-smooth coarse))) (< (abs (- (volume s) round-volume)) (* 0.05 (abs (- (volume coarse) round-volume))))))
(define (faceted o) (make-polyface-mesh (corners o) (second (object-arguments o))))
(displayln (nearer? (* 4/3 pi) (faceted (lowered (make-sphere origin 1 #:segments 16)))))        ; expect: #t
(displayln (nearer? (* 12 pi) (faceted (lowered (make-cylinder origin 3 2 #:segments 12)))))     ; expect: #t
(displayln (nearer? (* 2 pi pi 3) (faceted (lowered (make-torus origin 3 1 #:segments 16)))))    ; expect: #t
(displayln (volume (do-smooth brick)))                                                           ; expect: 24.0
(displayln (> (volume (do-smooth brick #:sharp pi)) 24))                                         ; expect: #t
(fails (refine brick 1e-6))   ; expect: refine: the solid would have millions of facets; give a larger length
(fails (refine brick 0))      ; expect: refine: length must be positive, got 0
(fails (simplify brick -1))   ; expect: simplify: tolerance must be positive, got -1
(fails (do-smooth 5))         ; expect: do-smooth: o must be a solid, got 5

; ---- text along a curve, and on a surface ----
(define round-text (text-on (make-circle origin 5) "round about" 1))
(displayln (near? (area round-text) (area (make-text origin 1 "round about")) 1e-3))             ; expect: #t
(displayln (every (lambda (p) (< 3.5 (distance p origin) 5.5)) (append-map (lambda (c) (curve-division c 8)) (outline round-text)))) ; expect: #t
(define straight (bounding-box (text-on (make-line origin (xy 10 0)) "AB" 1)))
(displayln (near? (cy (second straight)) 1 0.02))                                                ; expect: #t
(define wall (make-surface (lambda (u v) (xyz (* 5 (cos u)) (* 5 (sin u)) v)) 0 pi 0 4 #:nu 48 #:nv 4))
(define facade (text-on wall "facade" 1))
(displayln (list (surface? facade) (near? (area facade) (area (make-text origin 1 "facade")) 0.01))) ; expect: (#t #t)
(displayln (near? (cz (first (bounding-box facade))) 1.5 0.05))                                  ; expect: #t
(fails (text-on (make-line origin (xy 1 0)) "long" 1)) ; expect: text-on: the text is 2.9604 long, and the curve 1.0
(fails (text-on wall "a" 9))  ; expect: text-on: the text is 7.5653 long and 9 high, and the surface 15.705 and 4.0
(fails (text-on brick "a" 1)) ; expect: text-on: o must be a curve or a surface, got (make-box (xyz 0 0 0) (xyz 4 3 2))
(fails (text-on wall 5 1))    ; expect: text-on: string must be a string, got 5
; a tolerance larger than the solid, or than one of its parts
(displayln (simplify brick 1e50))                                                                ; expect: (empty-object)
; expect warning 56: simplify: the tolerance is larger than o: nothing is made (the empty object)
