; mates: closed forms of the places; joints: values, ranges, chains
(import (visualscheme) (visualscheme assembly))
(define box (make-box origin (xyz 2 3 4)))
(define (corner o) (first (bounding-box o)))
(define (top o) (second (bounding-box o)))
(define (at? o p q) (and (near? (corner o) p 1e-9) (near? (top o) q 1e-9)))

; a box with its top, seen from there, on the ground
(displayln (at? (mate box (list (xyz 1 1.5 4) uz) origin) (xyz -1 -1.5 0) (xyz 1 1.5 4))) ; expect: #t
(displayln (at? (mate box (list (xyz 1 1.5 0) (- uz)) (list (xyz 5 5 5) ux) #:offset 1) (xyz 6 4 3.5) (xyz 10 6 6.5))) ; expect: #t
(displayln (at? (mate box (list (xyz 1 1.5 0) uz) (xyz 0 0 7) #:flip #f) (xyz -1 -1.5 7) (xyz 1 1.5 11))) ; expect: #t
(displayln (at? (mate box (list (xyz 1 1.5 0) uz) (xyz 0 0 7) #:flip #f #:angle pi/2) (xyz -1.5 -1 7) (xyz 1.5 1 11))) ; expect: #t
; places of each kind, and X directions
(define face (make-region (make-rectangle (xyz 0 0 4) (xyz 2 3 4))))
(displayln (equal? (place-frame face) (place-frame (list (centroid face) uz)))) ; expect: #t
(displayln (at? (mate box face (translation-matrix (vxyz 0 0 9))) (xyz -1 -1.5 9) (xyz 1 1.5 13))) ; expect: #t
(displayln (at? (mate box (list (xyz 0 0 0) uz uy) (list origin uz ux) #:flip #f) (xyz 0 -2 0) (xyz 3 0 4))) ; expect: #t
; random places: the two frames meet, turned by half a turn about X
(define (random-direction) (vsph 1 (random 2pi) (acos (- 1 (random 2.0)))))
(define (random-place) (list (xyz (random 9.0) (random 9.0) (random 9.0)) (random-direction) (random-direction)))
(define rods (lambda (place) (let ((m (place-frame place))) (map (lambda (v) (do-transform (make-line origin v) m)) (list (xyz 1 0 0) (xyz 0 1 0) (xyz 0 0 1))))))
(define (end o) (curve-point o (curve-length o)))
(displayln
  (every (lambda (i)
           (let* ((a (random-place)) (b (random-place)) (moved (map (lambda (r) (mate r a b)) (rods a))) (there (rods b)) (o (car b)))
             (and (near? (curve-point (first moved) 0) o 1e-9)
                  (near? (end (first moved)) (end (first there)) 1e-9)
                  (near? (end (second moved)) (p-v o (p->q o (end (second there)))) 1e-9)
                  (near? (end (third moved)) (p-v o (p->q o (end (third there)))) 1e-9))))
         (iota 200))) ; expect: #t

; joints
(define arm (make-box (xyz 0 -1 0) (xyz 10 1 1)))
(displayln (at? (joint arm 'revolute origin pi/2 #:range (list 0 pi)) (xyz -1 0 0) (xyz 1 10 1))) ; expect: #t
(displayln (at? (joint arm 'prismatic (list origin ux) 3 #:range '(0 5)) (xyz 3 -1 0) (xyz 13 1 1))) ; expect: #t
(displayln (at? (joint arm 'cylindrical origin (list pi 2)) (xyz -10 -1 2) (xyz 0 1 3))) ; expect: #t
(displayln (volume (joint (part "arm" arm) 'revolute (list (xyz 5 0 0) uy) 1))) ; expect: 20.0
(displayln (object-part (mate (part "arm" arm) origin (xyz 1 1 1)))) ; expect: arm
(define (says thunk) (displayln (guard (e (#t (condition/report-string e))) (thunk))))
(says (lambda () (joint arm 'revolute origin 4 #:range (list 0 3)))) ; expect: joint: value must be from 0 to 3, got 4
(says (lambda () (joint arm 'hinge origin 4))) ; expect: joint: kind must be 'revolute, 'prismatic or 'cylindrical, got hinge
(says (lambda () (joint arm 'revolute origin 4 #:range '(3 0)))) ; expect: joint: range must be a list of the least and the greatest value, got (3 0)
(says (lambda () (joint arm 'cylindrical origin 4))) ; expect: joint: value must be a list of an angle and a distance, got 4
(says (lambda () (mate arm 5 origin))) ; expect: mate: place must be a point, a matrix, a face or a list of a point, its normal and perhaps its X direction, got 5
(says (lambda () (mate arm origin (list origin uz uz)))) ; expect: mate: target: its X direction must not be along its normal, got (vxyz 0 0 1)
(says (lambda () (mate 5 origin origin))) ; expect: mate: o must be an object or a list of objects, got 5
(says (lambda () (mate arm origin origin #:offset 'a))) ; expect: mate: offset must be a number, got a
