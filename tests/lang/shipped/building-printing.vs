; (visualscheme building): checks of solids for printing, by closed forms
(import (visualscheme) (visualscheme building))
(define (box a b c d e f) (make-box (xyz a b c) (xyz d e f)))
(define (kinds found) (map print-fault-kind found))
(define (only kind found) (filter (lambda (f) (eq? (print-fault-kind f) kind)) found))
(define (values-of kind found) (map (lambda (f) (/ (round (* 1e6 (print-fault-value f))) 1e6)) (only kind found)))

; the six walls of a box shell, its void, and the ceiling of the void
(define shell (subtract (box 0 0 0 10 10 10) (box 0.5 0.5 0.5 9.5 9.5 9.5)))
(define found (check-print shell #:wall 0.6 #:gap 0.3))
(displayln (kinds found))                            ; expect: (wall wall wall wall wall wall overhang void)
(displayln (append (values-of 'wall found) (values-of 'void found)))     ; expect: (0.5 0.5 0.5 0.5 0.5 0.5 729.0)
(displayln (print-fault-place (last found)))         ; expect: (xyz 5 5 5)
(displayln (map (lambda (f) (let ((p (print-fault-place f))) (and (contains? shell p) (near? (print-fault-area f) 81)))) (only 'wall found))) ; expect: (#t #t #t #t #t #t)
(displayln (kinds (check-print shell #:wall 0.5)))   ; expect: (overhang void)
(displayln (near? (print-fault-value (thinnest-wall (subtract (box 0 0 0 10 10 10) (box 0.5 0.7 0.25 9.5 9.5 9.5)))) 0.25)) ; expect: #t
; turned, the walls keep their thickness
(define turned (do-rotate shell (xyz 1 2 3) (vxyz 1 2 3) 0.7))
(displayln (values-of 'wall (check-print turned #:wall 0.6 #:overhang #f #:gap #f)))   ; expect: (0.5 0.5 0.5 0.5 0.5 0.5)

; an overhang is measured from the vertical: at the limit it is none; faces on the plate are none
(define (leaning degrees) (let ((x (tan (degrees->radians degrees)))) (do-extrude (make-polygon (xz 0 0) (xz 1 0) (xz (+ 1 x) 1) (xz 0 1)) (vxyz 0 4 0))))
(define (overhangs o limit) (map (lambda (f) (list (/ (round (* 1e6 (radians->degrees (print-fault-value f)))) 1e6) (near? (print-fault-area f) (/ 4 (cos (print-fault-value f))) 1e-6)))
                              (check-print o #:wall 0 #:gap 0 #:overhang (degrees->radians limit))))
(displayln (map (lambda (d) (overhangs (leaning d) 45)) '(30 45 50 70)))   ; expect: (() () ((50.0 #t)) ((70.0 #t)))
(displayln (overhangs (leaning 45) 44))                                    ; expect: ((45.0 #t))
(displayln (values-of 'overhang (check-print (list (box 0 0 0 1 1 5) (box 0 0 4 6 1 5)) #:wall 0 #:gap 0)))    ; expect: (1.570796)

; a void in a ball, with a loose ball in it
(define hollow (subtract (make-sphere origin 10) (make-sphere origin 9)))
(define hollow-found (check-print hollow #:wall 1.05 #:overhang #f))
(displayln (list (kinds hollow-found) (near? (print-fault-value (first hollow-found)) 1 0.01) (near? (print-fault-value (second hollow-found)) (* 4/3 pi 729) 10)
                 (near? (distance origin (print-fault-place (first hollow-found))) 9.5 0.05)))
; expect: ((wall void) #t #t #t)
(displayln (kinds (check-print (unite hollow (make-sphere origin 2)) #:wall 0 #:overhang #f))) ; expect: (void piece)

; two loose cubes with a narrow gap; an open slot; a wall behind a gap is measured by itself
(define cubes (check-print (list (box 0 0 0 1 1 1) (box 1.1 0 0 2 1 1)) #:wall 0.5 #:gap 0.2))
(displayln (list (kinds cubes) (values-of 'gap cubes) (values-of 'piece cubes) (near? (cx (print-fault-place (second cubes))) 1.05))) ; expect: ((piece gap) (0.1) (0.9) #t)
(displayln (kinds (check-print (subtract (box 0 0 0 4 4 4) (box 1 -1 1 1.2 5 5)) #:wall 0.5 #:gap 0.2)))   ; expect: ()
(displayln (kinds (check-print (subtract (box 0 0 0 4 4 4) (box 1 -1 1 1.2 5 5)) #:wall 0.5 #:gap 0.21)))  ; expect: (gap)
(displayln (values-of 'wall (check-print (list (box 0 0 0 1 9 9) (box 1.2 0 0 1.5 9 9) (box 1.7 0 0 3 9 9) (box 0 0 -1 3 9 0)) #:wall 2.5 #:overhang #f #:gap 0)))
; expect: (0.3 1.0 1.0 1.3)
; edges that are sharper than 30 degrees are walls without thickness; a block has its least side
(displayln (map (lambda (o) (let ((w (thinnest-wall o))) (and w (print-fault-value w)))) (list (make-wedge (xyz 0 0 0) (xyz 10 1 1)) (make-wedge origin 1 1 1) (box 0 0 0 1 2 3) (empty-object))))
; expect: (0.0 1.0 1.0 #f)
(displayln (kinds (check-print (box 0 0 0 2 2 2))))          ; expect: ()
(displayln (check-print '()))                                ; expect: ()
(units 'mm)
(displayln (map (lambda (t) (kinds (check-print (box 0 0 0 t 9 9)))) '(0.7 0.9)))      ; expect: ((wall) ())

(define-syntax fails (syntax-rules () ((_ e) (displayln (guard (x (#t (error-object-message x))) e "accepted")))))
(fails (check-print 3))                                      ; expect: check-print: o must be a solid, got 3
(fails (check-print (make-circle origin 1)))                 ; expect: check-print: o must be a solid, got (make-circle (xyz 0 0 0) 1)
(fails (check-print shell #:wall -1))                        ; expect: check-print: wall must be a number of 0 or more, or #f, got -1
(fails (check-print shell #:overhang 45))                    ; expect: check-print: overhang must be radians from 0 to pi/2, or #f, got 45; (degrees->radians 45) is 45 degrees
(fails (thinnest-wall "a"))                                  ; expect: thinnest-wall: o must be a solid, got "a"
