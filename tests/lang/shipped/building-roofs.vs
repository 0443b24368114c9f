; (visualscheme building): roofs by closed forms, with holes, gables and overhangs; each message for bad input
(import (visualscheme) (visualscheme building))
(define box (list (xy 0 0) (xy 6 0) (xy 6 4) (xy 0 4)))
(define court (list (xy 2.5 1.5) (xy 3.5 1.5) (xy 3.5 2.5) (xy 2.5 2.5)))
(define ell (list (xy 0 0) (xy 10 0) (xy 10 4) (xy 5 4) (xy 5 9) (xy 0 9)))
(define (hipped w d slope) (let ((a (min w d)) (b (max w d))) (* slope (+ (/ (* a a (- b a)) 4) (/ (* a a a) 6)))))
(define (same? o v) (and (solid? o) (near? (/ (volume o) v) 1 1e-9)))

; the volume of a hipped roof at several pitches; both directions of the outline; any height of it
(displayln (map (lambda (p) (same? (roof box #:pitch (degrees->radians p)) (hipped 6 4 (tan (degrees->radians p))))) '(1 20 45 60 89)))
; expect: (#t #t #t #t #t)
(displayln (list (same? (roof (reverse box) #:pitch (degrees->radians 45)) (hipped 6 4 1)) (same? (roof (map (lambda (p) (+z p 7)) box) #:pitch (degrees->radians 45)) (hipped 6 4 1))))
; expect: (#t #t)
; level eaves: the overhang widens the outline, and lowers it
(displayln (list (same? (roof box #:pitch (degrees->radians 45) #:overhang 1/2) (hipped 7 5 1)) (same? (roof (reverse box) #:pitch (degrees->radians 45) #:overhang 1/2) (hipped 7 5 1))))
; expect: (#t #t)
(displayln (list (same? (roof box #:pitch (degrees->radians 45) #:gables '(2 4)) 24) (same? (roof box #:pitch (degrees->radians 45) #:gables '(1 2 3)) (* 1/2 6 6 4))))
; expect: (#t #t)
; 45 and 26.6 degrees on opposite edges between gables: heights 4/3, a triangle of base 4
(displayln (same? (roof box #:pitch (list (/ pi 4) (/ pi 4) (atan 1/2) (/ pi 4)) #:gables '(2 4)) (* 1/2 4 4/3 6)))
; expect: #t

; faces: their areas times the cosine of the pitch are the outline's area; nothing is missing at a valley or courtyard
(define (plan-area faces pitch)
  (* (cos (degrees->radians pitch)) (apply + (map (lambda (f) (area (make-region (make-polygon (cdr f))))) faces))))
(displayln (list (near? (plan-area (roof-faces ell #:pitch (degrees->radians 30)) 30) 65) (near? (plan-area (roof-faces (list box court) #:pitch (degrees->radians 50)) 50) 23)
                 (near? (plan-area (roof-faces (list box court) #:pitch (degrees->radians 50) #:overhang 1/4) 50) (- (* 6.5 4.5) 1/4))))
; expect: (#t #t #t)
(displayln (list (solid? (roof ell #:pitch (degrees->radians 40) #:gables '(2 5) #:overhang 0.5 #:thickness 0.2)) (solid? (roof (list box court) #:pitch (degrees->radians 40)))
                 (solid? (roof (map-division (lambda (a) (pol 5 a)) 0 2pi 36 #f) #:pitch (degrees->radians 30))) (solid? (roof ell #:pitch (map degrees->radians '(30 40 45 50 45 30)) #:overhang 1/2))))
; expect: (#t #t #t #t)
; a roof of some thickness has its outline's area times that
(displayln (near? (volume (roof box #:pitch (degrees->radians 45) #:thickness 0.01)) 0.24 1e-3)) ; expect: #t
(define stepped (list (xy 0 0) (xy 5 0) (xy 9 0) (xy 9 6) (xy 0 6)))
(displayln (map first (roof-faces stepped #:pitch (map degrees->radians '(30 45 45 45 45))))) ; expect: (1 2 3 4 5 #f)

(define-syntax fails (syntax-rules () ((_ e) (displayln (guard (x (#t (error-object-message x))) e "accepted")))))
(fails (roof ell #:pitch (/ pi 2)))                   ; expect: roof: pitch must be radians between 0 and pi/2, or a list of them, got 1.5707963267948966; (degrees->radians 35) is 35 degrees
(fails (roof ell #:pitch 0))                    ; expect: roof: pitch must be radians between 0 and pi/2, or a list of them, got 0; (degrees->radians 35) is 35 degrees
(for-each (lambda (p) (fails (roof box #:pitch p)) (fails (roof-faces box #:pitch p))) (list 0 pi/2 0. (degrees->radians 90)))
; expect: roof: pitch must be radians between 0 and pi/2, or a list of them, got 0; (degrees->radians 35) is 35 degrees
; expect: roof-faces: pitch must be radians between 0 and pi/2, or a list of them, got 0; (degrees->radians 35) is 35 degrees
; expect: roof: pitch must be radians between 0 and pi/2, or a list of them, got 1.5707963267948966; (degrees->radians 35) is 35 degrees
; expect: roof-faces: pitch must be radians between 0 and pi/2, or a list of them, got 1.5707963267948966; (degrees->radians 35) is 35 degrees
; expect: roof: pitch must be radians between 0 and pi/2, or a list of them, got 0.0; (degrees->radians 35) is 35 degrees
; expect: roof-faces: pitch must be radians between 0 and pi/2, or a list of them, got 0.0; (degrees->radians 35) is 35 degrees
; expect: roof: pitch must be radians between 0 and pi/2, or a list of them, got 1.5707963267948966; (degrees->radians 35) is 35 degrees
; expect: roof-faces: pitch must be radians between 0 and pi/2, or a list of them, got 1.5707963267948966; (degrees->radians 35) is 35 degrees
(fails (roof ell #:pitch (map degrees->radians '(30 40))))           ; expect: roof: pitch must be 6 numbers, one for each edge, got 2
(fails (roof box #:gables '(5)))              ; expect: roof: gables must be numbers of edges from 1 to 4, got (5)
(fails (roof box #:gables '(1 2 3 4)))        ; expect: straight-skeleton: the edges never meet: more edges must move inwards
(fails (roof box #:overhang -1))              ; expect: roof: overhang must be a number of 0 or more, got -1
(fails (roof box #:thickness 0))              ; expect: roof: thickness must be a positive number, got 0
(fails (roof 3))                              ; expect: roof: outline must be a list of three points or more, or a list of such lists, got 3
(fails (roof (list (xy 0 0) (xyz 4 4 1) (xy 4 0)))) ; expect: roof: the points of outline must have one height, got ((xyz 0 0 0) (xyz 4 4 1) (xyz 4 0 0))
(fails (roof (list (xy 0 0) (xy 4 4) (xy 4 0) (xy 0 4)))) ; expect: roof: the outline crosses itself at (xyz 2 2 0)
(fails (roof-faces (list (xyz 0 0 3) (xyz 4 4 3) (xyz 4 0 3) (xyz 0 4 3)))) ; expect: roof-faces: the outline crosses itself at (xyz 2 2 3)
(fails (roof (list (list (xy 0 0) (xy 6 0) (xy 6 4) (xy 0 4)) (list (xy 1 1) (xy 7 1) (xy 7 2) (xy 1 2))))) ; expect: roof: two loops of the outline cross at (xyz 6 1 0)
(displayln (near? (volume (roof (list (xy 0 0) (xy 6 0) (xy 6 4) (xy 0 4) (xy 0 0)) #:pitch pi/4)) 56/3)) ; expect: #t
(fails (roof (list box court) #:overhang 1))  ; expect: roof: the overhang closes the outline at (xyz 2.5 1.5 0): make it less
(fails (roof stepped #:pitch (map degrees->radians '(30 45 45 45 45)))) ; expect: roof: parallel edges of unequal pitch make a vertical step, which has no solid: give them one pitch, or use roof-faces
