; (visualscheme building): curtain walls, and walls under roofs, by closed forms
(import (visualscheme) (visualscheme building))
; 6 m in 5 columns and 2 rows: 6 mullions, 3 transoms a column, 10 panes
(define plain (curtain-wall (list (xy 0 0) (xy 6 0)) #:height 3 #:grid '(1.25 1.5) #:frame 0.06 #:panel #f))
(displayln (near? (volume plain) (* 0.06 0.06 (+ (* 6 3) (* 3 5 (- 1.2 0.06)))) 1e-9)) ; expect: #t
(displayln (near? (- (volume (curtain-wall (list (xy 0 0) (xy 6 0)) #:height 3 #:grid '(1.25 1.5))) (volume plain)) (* 0.024 10 (- 1.2 0.06) (- 1.47 0.06)) 1e-9)) ; expect: #t
(displayln (bounding-box plain)) ; expect: ((xyz -0.03 -0.03 0) (xyz 6.03 0.03 3))
(define (own w h) (make-box origin (xyz w 0.1 h)))
(displayln (near? (- (volume (curtain-wall (list (xyz 0 0 2) (xyz 0 6 2)) #:base 1 #:height 3 #:grid '(1.25 1.5) #:panel own)) (volume plain)) (* 0.1 10 1.14 1.41) 1e-9)) ; expect: #t
(displayln (map (lambda (p) (solid? (curtain-wall p #:height 3))) (list (make-arc origin 5 0 pi) (make-circle origin 4) (make-rectangle origin (xy 5 3))))) ; expect: (#t #t #t)

; a gable wall under a roof of 45 degrees: the wall's triangle
(define plan (list (xyz 0 0 3) (xyz 8 0 3) (xyz 8 6 3) (xyz 0 6 3)))
(define faces (roof-faces plan #:pitch pi/4 #:gables '(2 4)))
(define shell (join-walls (wall (make-rectangle (xy 0 0) (xy 8 6)) #:height 3 #:align 'right #:layers '((0.1 brick) (0.2 block))) (wall (list (xy 4 0.3) (xy 4 5.7)) #:height 2 #:layers 0.2)))
(define high (walls-under shell faces))
(displayln (map (lambda (w) (near? (wall-height w) 6)) high)) ; expect: (#t #t)
; of the gables 0.3 deep, of the eaves' walls the wedge below the plane, of the partition a trapezoid
(displayln (near? (volume (unite high)) (+ (* 0.2 (- (+ (* 6 3) 9) (* 2 (+ (* 0.3 3) (* 0.5 0.3 0.3)))))
                                           (* 3 (- 48 (* 7.4 5.4))) (* 2 0.3 9) (* 2 7.4 (* 0.5 0.3 0.3))) 1e-6)) ; expect: #t
(displayln (near? (apply + (map volume (append-map wall-layers high))) (volume (unite high)) 1e-6)) ; expect: #t
(displayln (near? (volume (window (first high) (xy 8 3) 1 1 #:sill 3.5 #:fill #f)) (- (volume (first high)) 0.3) 1e-6)) ; expect: #t
(define hipped (roof-faces plan #:pitch pi/4 #:overhang 0.4))
(displayln (near? (volume (intersect (roof plan #:pitch pi/4 #:overhang 0.4 #:thickness 0.25) (unite (walls-under shell hipped #:thickness 0.25)))) 0 1e-6)) ; expect: #t

(define-syntax fails (syntax-rules () ((_ e) (displayln (guard (x (#t (error-object-message x))) e "accepted")))))
(fails (curtain-wall (list (xy 0 0) (xy 6 0)) #:grid 3))        ; expect: curtain-wall: grid must be the greatest width and height of its cells, got 3
(fails (curtain-wall (list (xy 0 0) (xy 6 0)) #:grid '(1e-5 1))) ; expect: curtain-wall: a grid of 0.00001 makes more than 10000 columns
(fails (curtain-wall (list (xy 0 0) (xy 0.05 0))))              ; expect: curtain-wall: a cell at (xyz 0 0 0) is narrower than the frame of 0.06
(fails (curtain-wall (list (xy 0 0) (xy 6 0)) #:panel 3))       ; expect: curtain-wall: panel must be a procedure of width and height, or #f, got 3
(fails (curtain-wall 3))                                        ; expect: curtain-wall: path must be a curve, or a list of two points or more, got 3
(fails (walls-under shell 3))                                   ; expect: walls-under: faces must be the faces of a roof, as roof-faces returns them, got 3
(fails (walls-under shell faces #:thickness -1))                ; expect: walls-under: thickness must be a number of 0 or more, got -1
(fails (walls-under (wall (list (xy 0 0) (xy 6 0)) #:base 20) faces)) ; expect: walls-under: the roof lies below the foot of the wall from (xyz 0 0 0)
