; (visualscheme building): clashes of parts, by closed forms
(import (visualscheme) (visualscheme building))
(define (shown c) (list (clash-kind c) (clash-names c)))
(define wall-part (layer "wall" (make-box (xyz 0 0 0) (xyz 1 1 1))))
(define pipe (layer "pipe" (make-box (xyz 0.9 0.5 0.5) (xyz 2 1.5 0.75))))
(define parts (list wall-part pipe (make-box (xyz 1 0 0) (xyz 2 0.4 1)) (make-box (xyz 2.05 0 0) (xyz 3 1 1)) (make-box (xyz 1 1 1) (xyz 1.5 1.5 1.5))))
(define (check who found)
  (displayln (map shown found))
  (displayln (and (near? (clash-volume (first found)) 0.0125) (near? (clash-area (second found)) 0.4) (= 0 (clash-area (third found)) (clash-volume (second found)))
                  (every (lambda (c) (near? (clash-gap c) 0.05)) (drop found 3)) (every (lambda (c d) (near? (distance (clash-place c) (who d)) 0 1e-7)) (take found 3)
                    (list (xyz 0.95 0.75 0.625) (xyz 1 0.2 0.5) (xyz 1 1 1))))))
(define (turned x) (do-rotate x (xyz 1 2 3) (vxyz 1 2 3) 0.7))
(define (turned-point p) (let ((b (bounding-box (turned (make-sphere p 1e-3))))) (mid (first b) (second b))))
(check (lambda (p) p) (clashes parts #:clearance 0.1))
; expect: ((overlap (wall pipe)) (touch (wall 3)) (touch (wall 5)) (near (pipe 4)) (near (3 4)))
; expect: #t
; the same parts, turned: their faces lie on no grid
(check turned-point (clashes (map turned parts) #:clearance 0.1))
; expect: ((overlap (wall pipe)) (touch (wall 3)) (touch (wall 5)) (near (pipe 4)) (near (3 4)))
; expect: #t
(displayln (length (clashes parts)))                                   ; expect: 3
(displayln (map shown (clashes (unite parts))))                        ; expect: ((overlap (wall pipe)) (touch (wall 3)) (touch (wall 5)))

; coordinates that differ in the last digit touch; equal boxes and a box within another overlap
(define (box a b) (make-box (xyz a 0 0) (xyz b 1 1)))
(define tenths (clashes (list (box 0 (* 3 0.1)) (box 0.3 0.7))))
(displayln (map (lambda (c) (list (clash-kind c) (near? (clash-area c) 1) (clash-volume c))) tenths))     ; expect: ((touch #t 0.0))
(displayln (map (lambda (c) (near? (clash-volume c) 0.3)) (clashes (list (box 0 0.3) (box 0 0.3) (box 0.6 1) (box 0.5 2))))) ; expect: (#f #t)
(define nested (clashes (list (make-box (xyz 0 0 0) (xyz 3 3 3)) (make-box (xyz 1 1 1) (xyz 2 2 2)) (subtract (make-box (xyz -1 -1 -1) (xyz 4 4 4)) (make-box (xyz 0 0 0) (xyz 3 3 3))))))
(displayln (map (lambda (c) (list (clash-kind c) (near? (clash-volume c) 1) (near? (clash-area c) 54) (clash-place c))) nested))
; expect: ((overlap #t #f (xyz 1.5 1.5 1.5)) (touch #f #t (xyz 1.5 1.5 1.5)))

; curved parts: the volume is that of the intersection; a peg fills its hole; lists are one part; walls are parts
(define balls (list (make-sphere origin 1) (make-sphere (xyz 1 0 0) 1)))
(displayln (= (clash-volume (first (clashes balls))) (volume (apply intersect balls))))                    ; expect: #t
(define peg (make-cylinder (xyz 0 0 0) 2 0.5))
(displayln (map clash-kind (clashes (list peg (subtract (make-box (xyz -1 -1 0) (xyz 1 1 2)) peg)))))      ; expect: (touch)
(displayln (map shown (clashes (list (list (box 0 1) (box 5 6)) (box 5.5 7)))))                            ; expect: ((overlap (1 2)))
(define corner (list (wall (list (xy 0 0) (xy 4 0))) (wall (list (xy 4 0) (xy 4 3)))))
(displayln (list (map clash-kind (clashes corner)) (map clash-kind (clashes (join-walls corner)))))        ; expect: ((overlap) (touch))
(displayln (list (clashes '()) (clashes (list (empty-object) (box 0 1))) (clashes (box 0 1))))             ; expect: (() () ())

; a grid of boxes, in any order, has as many touching faces as between its cells
(define cells (append-map (lambda (x) (append-map (lambda (y) (map (lambda (z) (make-box (xyz x y z) (xyz (+ x 1) (+ y 1) (+ z 1)))) (iota 4))) (iota 4))) (iota 4)))
(displayln (let ((found (clashes cells))) (list (count (lambda (c) (= (clash-area c) 1)) found) (length found) (every (lambda (c) (eq? (clash-kind c) 'touch)) found))))
; expect: (144 468 #t)

(define-syntax fails (syntax-rules () ((_ e) (displayln (guard (x (#t (error-object-message x))) e "accepted")))))
(fails (clashes 3))                                  ; expect: clashes: parts must be a list of solids, got 3
(fails (clashes (list (make-circle origin 1))))      ; expect: clashes: parts must be a list of solids, got (make-circle (xyz 0 0 0) 1)
(fails (clashes parts #:clearance -1))               ; expect: clashes: clearance must be a number of 0 or more, got -1
(fails (clashes (list (make-half-space (make-plane origin (vxyz 0 0 1))))))
; expect: clashes: the object is endless: intersect it with something finite, or subtract it from that

; random boxes on a grid of tenths: every pair has the kind, volume and area of the formula
(define-values (all-boxes ranges)
  (let* ((range (lambda () (let ((a (/ (random 30) 10))) (list a (+ a (/ (+ 1 (random 9)) 10)))))) (ranges (map (lambda (i) (list (range) (range) (range))) (iota 60))))
    (values (map (lambda (r) (make-box (apply xyz (map exact->inexact (map first r))) (apply xyz (map exact->inexact (map second r))))) ranges) (list->vector ranges))))
(define (common a b) (map (lambda (r s) (- (min (second r) (second s)) (max (first r) (first s)))) a b))
(define expected
  (append-map
    (lambda (i)
      (filter-map
        (lambda (j)
          (let ((c (common (vector-ref ranges i) (vector-ref ranges j))))
            (cond ((any negative? c) #f)
                  ((every positive? c) (list (+ i 1) (+ j 1) 'overlap (apply * c) 0))
                  (else (list (+ i 1) (+ j 1) 'touch 0 (if (= 1 (count zero? c)) (apply * (filter positive? c)) 0))))))
        (range (+ i 1) 60)))
    (iota 60)))
(define found (clashes all-boxes))
(displayln (list (= (length found) (length expected))
  (every (lambda (c)
           (let ((e (find (lambda (e) (equal? (take e 2) (clash-names c))) expected)))
             (and e (eq? (third e) (clash-kind c)) (near? (fourth e) (clash-volume c) 1e-12) (near? (fifth e) (clash-area c) 1e-12))))
    found)))
; expect: (#t #t)
